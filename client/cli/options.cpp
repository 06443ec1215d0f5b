#include "client/cli/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <sstream>

#include "client/sdk/machine_profile.h"

namespace kcs::cli {
namespace {

using client::Channel;
using client::CornerStrategy;
using client::ToleranceKind;

constexpr const char* kFooter =
    "Without --server everything is computed inside this process.\n"
    "Exit codes: 0 done, 1 refused (what cannot be planned, with its place),\n"
    "2 wrong command line, 3 no server answers, 4 a file cannot be read or written,\n"
    "5 an error inside kcs.";

const std::map<std::string, ToleranceKind> kToleranceKinds = {{"contour", ToleranceKind::kContourError},
                                                              {"corner", ToleranceKind::kCornerDistance}};
const std::map<std::string, CornerStrategy> kStrategies = {{"auto", CornerStrategy::kAuto},
                                                           {"interrupted", CornerStrategy::kInterrupted},
                                                           {"uninterrupted", CornerStrategy::kUninterrupted},
                                                           {"exact-stop", CornerStrategy::kExactStop}};
const std::map<std::string, Channel> kChannels = {
    {"velocity", Channel::kVelocity}, {"acceleration", Channel::kAcceleration}, {"jerk", Channel::kJerk}};

// An option whose value is one of the names of `choices`.
template <typename Value>
CLI::Option* add_choice(CLI::App& app, const std::string& name, Value& value,
                        const std::map<std::string, Value>& choices, const std::string& description) {
  return app
      .add_option_function<std::string>(
          name, [&value, &choices](const std::string& choice) { value = choices.at(choice); }, description)
      ->check(CLI::IsMember(&choices, CLI::ignore_case))
      ->option_text(" ");
}

void add_planning_options(CLI::App& app, Options& options) {
  std::string shipped;
  for (const client::ShippedProfile& profile : client::shipped_profiles()) {
    shipped += (shipped.empty() ? "" : ", ") + std::string(profile.name);
  }
  app.add_option("FILE", options.file, "G-code program; - reads standard input")->required()->option_text(" ");
  app.add_option("--machine", options.machine,
                 "limits of the machine: a profile's file name, or a\nbuilt-in profile (default: router):\n" + shipped)
      ->option_text("PROFILE.toml");
  app.add_option("--tolerance", options.plan.tolerance_mm, "how far corners may be cut (default: 0.01)")
      ->option_text("MM");
  add_choice(app, "--tolerance-kind", options.plan.tolerance_kind, kToleranceKinds,
             "contour: distance from the path (default);\ncorner: distance from the corner point");
  add_choice(app, "--strategy", options.plan.strategy, kStrategies,
             "how corners are taken: auto (default), interrupted,\nuninterrupted, exact-stop");
  app.add_option("--feed", options.plan.feed_mm_s, "replaces every programmed feed and the rapid")
      ->option_text("MM_PER_S");
  app.add_option("--start", options.plan.start_mm, "where the program starts (default: 0,0,0)")
      ->delimiter(',')
      ->option_text("X,Y,Z");
  app.add_option("--period", options.period_s, "time between two setpoints (default: 0.001)")->option_text("S");
  app.add_option("--server", options.server, "plan on this kcsd instead of inside this process")
      ->option_text("HOST:PORT");
}

CLI::App* add_command(CLI::App& app, Options& options, Command command, const std::string& name,
                      const std::string& description) {
  CLI::App* subcommand = app.add_subcommand(name, description);
  subcommand->footer(kFooter);
  subcommand->callback([&options, command] { options.command = command; });
  add_planning_options(*subcommand, options);
  return subcommand;
}

void add_commands(CLI::App& app, Options& options) {
  CLI::App* plan = add_command(app, options, Command::kPlan, "plan", "say how long a program takes, and why");
  plan->add_flag("--json", options.json, "print one JSON object instead of the table");

  CLI::App* stream = add_command(app, options, Command::kStream, "stream", "write the setpoints as CSV");
  stream->add_option("-o,--output", options.output, "file to write; - is standard output")
      ->required()
      ->option_text("OUT.csv");
  stream
      ->add_option_function<std::vector<std::string>>(
          "--channels",
          [&options](const std::vector<std::string>& names) {
            for (const std::string& name : names) options.channels.push_back(kChannels.at(name));
          },
          "further columns: velocity,acceleration,jerk")
      ->delimiter(',')
      ->check(CLI::IsMember(&kChannels))
      ->option_text("LIST");

  CLI::App* corners = add_command(app, options, Command::kCorners, "corners", "say how every corner is taken");
  corners->add_flag("--json", options.json, "print a JSON array instead of the table");

  CLI::App* plot = add_command(app, options, Command::kPlot, "plot", "draw path, speed, acceleration and jerk");
  plot->add_option("-o,--output", options.output, "picture to write")->required()->option_text("PLOT.svg|PLOT.png");
  plot->add_option("--from", options.from_s, "first moment to draw (default: 0)")->option_text("S");
  plot->add_option("--to", options.to_s, "last moment to draw (default: the end)")->option_text("S");
}

}  // namespace

std::optional<Message> parse_command_line(int argc, const char* const* argv, Options& options) {
  CLI::App app("Plans G-code programs with kcs: cycle time, corners, setpoints, pictures.", "kcsctl");
  app.require_subcommand(1);
  app.footer(std::string("kcsctl COMMAND --help says more about a command.\n") + kFooter);
  app.get_formatter()->column_width(26);
  add_commands(app, options);
  try {
    app.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    std::ostringstream out;
    std::ostringstream problems;
    const bool is_error = app.exit(error, out, problems) != 0;
    return Message{is_error ? "kcsctl: " + problems.str() : out.str(), is_error};
  }
}

}  // namespace kcs::cli
