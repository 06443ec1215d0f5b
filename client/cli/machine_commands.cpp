#include "client/cli/machine_commands.h"

#include <fmt/core.h>

#include <optional>
#include <string>

#include "client/cli/machine_json.h"
#include "client/cli/machines_table.h"
#include "client/cli/output.h"
#include "client/cli/planning_session.h"
#include "client/cli/run_screen.h"
#include "client/cli/run_view.h"
#include "client/cli/terminal.h"
#include "client/sdk/machine_profile.h"
#include "client/sdk/machines.h"

namespace kcs::cli {
namespace {

using client::AttachedMachine;
using client::Machines;
using client::Run;

constexpr std::string_view kMachines = "machines/";
constexpr std::string_view kRuns = "/runs/";

std::string full_name(const std::string& name) {
  return name.starts_with(kMachines) ? name : std::string(kMachines) + name;
}

// Throws client::Error ("NOT_FOUND") if it is not attached.
AttachedMachine find_attached(Machines& machines, const std::string& name) {
  for (AttachedMachine& machine : machines.list()) {
    if (machine.name == name) return std::move(machine);
  }
  throw client::Error("NOT_FOUND",
                      fmt::format("{} is not attached to this server; kcsctl machines lists those that are", name));
}

// The name of the run that the command line means.
std::string find_run(Machines& machines, const std::string& meant) {
  std::string name = full_name(meant);
  if (name.find(kRuns) != std::string::npos) return name;
  const AttachedMachine machine = find_attached(machines, name);
  if (machine.run.empty()) throw client::Error("FAILED_PRECONDITION", name + " is on no run");
  return machine.run;
}

std::string text_of(const Run& run, const Options& options) {
  return options.json ? run_json(run) : run_line(run) + "\n";
}

// For the view, if there is to be one. Before anything else: see Terminal.
void guard_terminal(std::optional<Terminal>& terminal, const Options& options) {
  if (!options.json && Terminal::is_there()) terminal.emplace();
}

void watch(Machines& machines, const std::string& name, std::optional<Terminal>& terminal, const Options& options) {
  const Run last = terminal ? RunScreen(*terminal, machines, machines.get(name), options.run.take_over).show()
                            : machines.watch(name, [&options](const Run& run) { print(text_of(run, options)); });
  if (last.state == client::RunState::kAborted) throw client::Error("ABORTED", name + " was aborted");
  if (last.state == client::RunState::kFailed) {
    throw client::Error("ABORTED", fmt::format("{} failed: {}", name, last.reason));
  }
}

std::string plan_program(const Options& options, const AttachedMachine& machine) {
  client::PlanOptions plan = options.plan;
  if (options.run.profile.empty()) {
    plan.machine = machine.limits;
    plan.machine.name = machine.name;
  } else {
    plan.machine = client::find_machine(options.run.profile);
  }
  if (plan.start_mm.empty()) plan.start_mm = machine.position_mm;
  client::Planner planner(options.server);
  return plan_file(planner, options.file, plan).name;
}

}  // namespace

void list_machines(const Options& options) {
  const std::vector<AttachedMachine> machines = Machines(options.server).list();
  print(options.json ? machines_json(machines) : machines_table(machines));
}

void run_plan(const Options& options) {
  std::optional<Terminal> terminal;
  if (options.run.watch) guard_terminal(terminal, options);
  Machines machines(options.server);
  const AttachedMachine machine = find_attached(machines, full_name(options.run.machine));
  const std::string plan = options.run.plan.empty() ? plan_program(options, machine) : options.run.plan;
  const Run run = machines.run_plan(machine.name, plan, options.run.feed_override_percent);
  if (options.run.watch) return watch(machines, run.name, terminal, options);
  print(text_of(run, options));
}

void operate_run(const Options& options) {
  Machines machines(options.server);
  const std::string name = find_run(machines, options.run.run);
  const auto operate = [&]() -> Run {
    switch (options.command) {
      case Command::kHold:
        return machines.hold(name);
      case Command::kResume:
        return machines.resume(name, options.run.take_over);
      case Command::kAbort:
        return machines.abort(name);
      default:
        return machines.set_feed_override(name, options.run.feed_override_percent.value(), options.run.take_over);
    }
  };
  print(text_of(operate(), options));
}

void watch_run(const Options& options) {
  std::optional<Terminal> terminal;
  guard_terminal(terminal, options);
  Machines machines(options.server);
  watch(machines, find_run(machines, options.run.run), terminal, options);
}

}  // namespace kcs::cli
