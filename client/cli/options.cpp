#include "client/cli/options.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <map>

#include "client/cli/machine_options.h"
#include "client/common/connection_options.h"
#include "client/common/exit_code.h"
#include "server/version/version.h"

namespace kcs::cli {
namespace {

using client::Channel;

std::string footer() {
  return std::string("Without --server everything is computed inside this process.\n") + client::kExitCodeHelp + ".";
}

const std::map<std::string, Channel> kChannels = {
    {"velocity", Channel::kVelocity},          {"acceleration", Channel::kAcceleration}, {"jerk", Channel::kJerk},
    {"path-position", Channel::kPathPosition}, {"segment", Channel::kSegment},           {"line", Channel::kLine}};

const std::map<std::string, SetpointFormat> kFormats = {
    {"csv", SetpointFormat::kCsv}, {"npy", SetpointFormat::kNumPy}, {"hal", SetpointFormat::kStreamer}};

void add_common_options(CLI::App& app, Options& options) {
  app.add_option("FILE", options.file, "G-code program; - reads standard input")->required()->option_text(" ");
  client::add_planning_options(app, options.machine, options.plan);
  app.add_option("--start-speed", options.plan.start_speed_mm_s,
                 "how fast the tool is at the start already,\nalong the first move (default: 0)")
      ->option_text("MM_PER_S");
  app.add_option("--start-acceleration", options.plan.start_acceleration_mm_s2,
                 "and how much faster it is getting (default: 0)")
      ->option_text("MM_PER_S2");
  app.add_option("--end-speed", options.plan.end_speed_mm_s,
                 "how fast it is to be at the end,\nalong the last move (default: 0)")
      ->option_text("MM_PER_S");
  app.add_option("--period", options.period_s,
                 "time between two setpoints (default: 0.001);\nwithout effect on plan and corners")
      ->option_text("S");
  client::add_connection_options(app, options.server, "plan on this kcsd instead of inside this process");
}

CLI::App* add_command(CLI::App& app, Options& options, Command command, const std::string& name,
                      const std::string& description) {
  CLI::App* subcommand = app.add_subcommand(name, description);
  subcommand->footer(footer());
  subcommand->callback([&options, command] { options.command = command; });
  add_common_options(*subcommand, options);
  return subcommand;
}

// Columns and format of the setpoints.
void add_channels(CLI::App& app, Options& options) {
  app.add_option_function<std::string>(
         "--format", [&options](const std::string& name) { options.format = kFormats.at(name); },
         "csv, npy (NumPy) or hal (LinuxCNC's halstreamer);\ndefault: by the end of the file's name, else csv")
      ->check(CLI::IsMember(&kFormats))
      ->option_text("NAME");
  app.add_option_function<std::vector<std::string>>(
         "--channels",
         [&options](const std::vector<std::string>& names) {
           for (const std::string& name : names) options.channels.push_back(kChannels.at(name));
         },
         "further columns: velocity,acceleration,jerk,\npath-position (mm of the way),segment (from 0),\nline (of the "
         "program, from 1)")
      ->delimiter(',')
      ->check(CLI::IsMember(&kChannels))
      ->option_text("LIST");
}

void add_commands(CLI::App& app, Options& options) {
  CLI::App* plan = add_command(app, options, Command::kPlan, "plan", "say how long a program takes, and why");
  plan->add_flag("--json", options.json, "print one JSON object instead of the table");

  CLI::App* stream = add_command(app, options, Command::kStream, "stream", "write the setpoints to a file");
  stream->add_option("-o,--output", options.output, "file to write; - is standard output")
      ->required()
      ->option_text("OUT.csv|npy|hal");
  add_channels(*stream, options);

  CLI::App* live = add_command(app, options, Command::kLive, "live", "plan a program of any length while it comes");
  live->add_option(
          "-o,--output", options.output,
          "file for the setpoints, written meanwhile (default:\nnone); - is standard output, with no table after them")
      ->option_text("OUT.csv|npy|hal");
  live->add_flag("--json", options.json, "print one JSON object instead of the table");
  add_channels(*live, options);

  CLI::App* corners = add_command(app, options, Command::kCorners, "corners", "say how every corner is taken");
  corners->add_flag("--json", options.json, "print a JSON array instead of the table");

  CLI::App* plot = add_command(app, options, Command::kPlot, "plot", "draw path, speed, acceleration and jerk");
  plot->add_option("-o,--output", options.output, "picture to write")->required()->option_text("PLOT.svg|PLOT.png");
  plot->add_option("--from", options.from_s, "first moment to draw (default: 0)")->option_text("S");
  plot->add_option("--to", options.to_s, "last moment to draw (default: the end)")->option_text("S");
}

void add_health_command(CLI::App& app, Options& options) {
  CLI::App* health = app.add_subcommand("health", "say whether a kcsd takes requests");
  health->footer(client::kExitCodeHelp + std::string("."));
  health->callback([&options] { options.command = Command::kHealth; });
  health
      ->add_option("--http", options.http, "where it speaks HTTP: its observe.http_listen\n(default: 127.0.0.1:50552)")
      ->option_text("HOST:PORT");
}

}  // namespace

std::optional<client::Message> parse_command_line(int argc, const char* const* argv, Options& options) {
  CLI::App app("Plans G-code programs with kcs (cycle time, corners, setpoints, pictures),\nand runs them on machines.",
               "kcsctl");
  app.require_subcommand(1);
  app.set_version_flag("--version", fmt::format("kcsctl {}", version_and_build()));
  app.footer(std::string("kcsctl COMMAND --help says more about a command.\n") + client::kExitCodeHelp + ".");
  app.get_formatter()->column_width(26);
  add_commands(app, options);
  add_machine_commands(app, options);
  add_health_command(app, options);
  return client::parse(app, argc, argv);
}

}  // namespace kcs::cli
