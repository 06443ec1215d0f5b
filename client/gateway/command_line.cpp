#include "client/gateway/command_line.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "client/common/connection_options.h"
#include "client/common/exit_code.h"
#include "client/common/planning_options.h"
#include "server/version/version.h"

namespace kcs::gateway {
namespace {

constexpr const char* kStarvedHelp = ", 6 starved: no setpoint was there when one was due.";

void add_source(CLI::App& app, CommandLine& options) {
  CLI::Option* file = app.add_option("FILE", options.file, "G-code program to have planned and to play");
  file->option_text(" ");
  app.add_option("--plan", options.plan, "plan to play that the server keeps, instead of FILE")
      ->excludes(file)
      ->option_text("plans/NAME");
  client::add_connection_options(app, options.server, "the kcsd to take the plan from");
}

// CLI::Range lets NaN pass.
std::string require_number(const std::string& text) {
  double number = 0;
  const bool is_number = CLI::detail::lexical_cast(text, number) && std::isfinite(number);
  return is_number ? "" : fmt::format("{} is no number", text);
}

void add_playing(CLI::App& app, CommandLine& options) {
  PlaybackOptions& playback = options.playback;
  app.add_option("--period", playback.period_s, "the drives' period (default: 0.001)")
      ->check(require_number)
      ->check(CLI::Range(1e-5, 10.0))
      ->option_text("S");
  app.add_option("--buffer", playback.buffer_s, "motion held ready against trouble on the network\n(default: 1)")
      ->check(require_number)
      ->check(CLI::Range(1e-3, 3600.0))
      ->option_text("S");
  app.add_option("--seconds", playback.seconds, "play only so much of the plan; the simulation ends\nin mid-motion")
      ->check(require_number)
      ->check(CLI::Range(1e-5, 1e9))
      ->option_text("S");
  app.add_flag("--fast", playback.simulated_time,
               fmt::format("play in simulated time, as fast as it computes,\n"
                           "instead of by the clock; ends as starved when no\n"
                           "setpoint has come for {:g} s",
                           kPatienceS));
  app.add_option("--record", playback.record, "write commanded and actual positions of every tick")
      ->option_text("FILE.csv");
  app.add_flag("--json", options.json, "print one JSON object instead of the table");
}

CLI::App* add_attach(CLI::App& app, CommandLine& options) {
  CLI::App* attach = app.add_subcommand("attach", "stay beside a machine and play what a server runs on it");
  attach->add_option("--config", options.attach, "settings; deploy/gateway.toml has them all")
      ->required()
      ->option_text("FILE.toml");
  client::add_connection_options(*attach, options.attach_server,
                                 "the kcsd to attach the machine to, instead of\nthat of the settings");
  attach
      ->add_option("--record", options.attach_record,
                   "write commanded and actual positions of every tick\n(simulated drives)")
      ->option_text("FILE.csv");
  attach->footer("SIGTERM or SIGINT brings the machine to rest and ends it.\n" + std::string(client::kExitCodeHelp) +
                 ".");
  return attach;
}

}  // namespace

std::optional<client::Message> parse_command_line(int argc, const char* const* argv, CommandLine& options) {
  CLI::App app("Plays a plan at the drives' period into simulated drives, and says how well they\nfollowed.",
               "kcs-gateway");
  app.set_version_flag("--version", fmt::format("kcs-gateway {}", version_and_build()));
  app.footer(std::string(client::kExitCodeHelp) + kStarvedHelp);
  app.get_formatter()->column_width(26);
  add_source(app, options);
  client::add_planning_options(app, options.machine, options.planning);
  add_playing(app, options);
  const CLI::App* attach = add_attach(app, options);
  app.callback([&options, attach] {
    if (attach->parsed()) return;
    if (options.server.address.empty()) throw CLI::RequiredError("--server");
    if (options.file.empty() && options.plan.empty()) throw CLI::RequiredError("Either FILE or --plan");
  });
  return client::parse(app, argc, argv);
}

}  // namespace kcs::gateway
