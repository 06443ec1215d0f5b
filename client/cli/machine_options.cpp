#include "client/cli/machine_options.h"

#include <CLI/CLI.hpp>

#include "client/common/connection_options.h"
#include "client/common/exit_code.h"

namespace kcs::cli {
namespace {

constexpr const char* kWatchHelp =
    "On a terminal: a view with keys for hold, resume, override and abort. Leaving it\n"
    "(q, Ctrl-C) lets the run go on. Elsewhere, and with --json: a line for every\n"
    "change. The exit code is 1 if the run is aborted or fails.\n";

CLI::App* add_command(CLI::App& app, Options& options, Command command, const std::string& name,
                      const std::string& description) {
  CLI::App* subcommand = app.add_subcommand(name, description);
  subcommand->footer(client::kExitCodeHelp + std::string("."));
  subcommand->callback([&options, command] { options.command = command; });
  client::add_connection_options(*subcommand, options.server, "the kcsd that the machine is attached to")->required();
  return subcommand;
}

void add_json(CLI::App& app, Options& options) {
  app.add_flag("--json", options.json, "print each as a JSON object in one line");
}

void add_run_command(CLI::App& app, Options& options) {
  CLI::App* run = add_command(app, options, Command::kRun, "run", "run a program, or a plan, on a machine");
  CLI::Option* file = run->add_option("FILE", options.file, "G-code program; - reads standard input")->option_text(" ");
  CLI::Option* plan = run->add_option("--plan", options.run.plan, "instead of a program: a plan that the server keeps")
                          ->option_text("PLAN")
                          ->excludes(file);
  run->callback([&options, file, plan] {
    if (file->empty() && plan->empty()) throw CLI::RequiredError("FILE, or --plan,");
    options.command = Command::kRun;
  });
  run->add_option("--on", options.run.machine, "the machine")->required()->option_text("machines/NAME");
  run->add_option("--override", options.run.feed_override_percent, "feed override at first, 0 to 200 (default: 100)")
      ->option_text("PERCENT");
  run->add_flag("--watch", options.run.watch, "and show how it goes, as kcsctl watch does");
  add_json(*run, options);
  client::add_planning_options(*run, options.run.profile, options.plan,
                               {.machine = "the machine's own", .start = "where it stands"});
}

// A command about one run.
CLI::App* add_operation(CLI::App& app, Options& options, Command command, const std::string& name,
                        const std::string& description) {
  CLI::App* operation = add_command(app, options, command, name, description);
  operation->add_option("RUN", options.run.run, "machines/NAME/runs/NUMBER; or the machine, for what it\nis running")
      ->required()
      ->option_text(" ");
  add_json(*operation, options);
  return operation;
}

void add_take_over(CLI::App& app, Options& options) {
  app.add_flag("--take-over", options.run.take_over, "control the run even if somebody else does");
}

}  // namespace

void add_machine_commands(CLI::App& app, Options& options) {
  add_json(*add_command(app, options, Command::kMachines, "machines", "list the machines that are attached"), options);
  add_run_command(app, options);
  add_operation(app, options, Command::kHold, "hold", "bring a run to rest on its path");
  add_take_over(*add_operation(app, options, Command::kResume, "resume", "go on with a run that is held"), options);
  add_operation(app, options, Command::kAbort, "abort", "bring a run to rest on its path, and end it");
  CLI::App* feed = add_operation(app, options, Command::kOverride, "override", "set the pace of a run");
  feed->add_option("PERCENT", options.run.feed_override_percent, "of the planned feed, 0 to 200")
      ->required()
      ->option_text(" ");
  add_take_over(*feed, options);
  CLI::App* watch = add_operation(app, options, Command::kWatch, "watch", "show how a run goes, and operate it");
  add_take_over(*watch, options);
  watch->footer(std::string(kWatchHelp) + client::kExitCodeHelp + ".");
}

}  // namespace kcs::cli
