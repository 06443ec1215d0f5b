#include "server/service/machine_runs.h"

#include <spdlog/spdlog.h>

#include <chrono>
#include <thread>
#include <utility>

#include "server/runs/not_now.h"
#include "server/service/status.h"

namespace kcs::service {
namespace {

constexpr std::chrono::milliseconds kReport{50};  // those who watch are told no more often
constexpr std::chrono::milliseconds kLook{10};
constexpr std::chrono::milliseconds kDatabaseLook{500};  // at a run whose machine is elsewhere, or nowhere

using Clock = std::chrono::steady_clock;

// Where nobody is told apart, everybody is the controller.
const std::string& controller_of(const Caller& caller) { return caller.identity.owner; }

}  // namespace

runs::Run MachineRuns::begin(const Caller& caller, const std::string& machine, const std::string& plan, double rate) {
  machines_.find(machine);  // nothing is planned for one that is not there
  const jobs::PlanPointer loaded = plans_.load(caller, plan);
  const Machines::MachinePointer attached = machines_.find(machine);  // it may have come anew meanwhile
  const auto turn = attached->take_turn();
  attached->require_ready_for(*loaded);
  // It stands without a run: what the store knows of one never came to it.
  if (const auto lost = archive_.open_run(machine)) close(*lost, store::RunRecordState::kFailed);
  const runs::Run run = decode_record(
      archive_.add_run({.machine = machine, .plan = plan, .controller = controller_of(caller), .feed_override = rate}));
  attached->begin(run, loaded);
  return attached->run().value_or(run);
}

runs::Run MachineRuns::get(const std::string& name) {
  const auto live = find_live(name);
  return live ? *live : get_kept(name);
}

std::optional<runs::Run> MachineRuns::find_live(const std::string& name) const {
  const Machines::MachinePointer machine = machines_.try_find(name.substr(0, name.find("/runs/")));
  auto run = machine ? machine->run() : std::nullopt;
  if (run && run->name != name) run.reset();
  return run;
}

runs::Run MachineRuns::get_kept(const std::string& name) {
  const auto record = archive_.find_run(name);
  if (!record) throw NoSuchRun(name);
  return decode_record(*record);
}

runs::Run MachineRuns::hold(const std::string& run) { return noted(machines_.machine_of(run)->hold(run)); }

runs::Run MachineRuns::abort(const std::string& name) {
  const Machines::MachinePointer machine = machines_.machine_of(name);
  if (machine->is_on(name)) return noted(machine->abort(name));
  const auto turn = machine->take_turn();
  if (machine->is_on(name)) return noted(machine->abort(name));  // it has just taken it up
  const auto record = archive_.find_run(name);
  if (!record) throw NoSuchRun(name);
  if (record->state != store::RunRecordState::kOpen) throw runs::NotNow(name + " is over");
  const runs::Run aborted = close(*record, store::RunRecordState::kAborted);
  if (machine->last_report().run == name) machine->drop_run();  // and need not wait for its plan any more
  return aborted;
}

runs::Run MachineRuns::close(store::RunRecord record, store::RunRecordState state) {
  record.state = state;
  record.reason = "its machine does not know of it";
  archive_.update_run(record);
  return decode_record(record);
}

runs::Run MachineRuns::resume(const Caller& caller, const std::string& run, bool take_over) {
  return noted(require_control(caller, run, take_over)->resume(run));
}

runs::Run MachineRuns::set_rate(const Caller& caller, const std::string& run, double rate, bool take_over) {
  return noted(require_control(caller, run, take_over)->set_rate(run, rate));
}

void MachineRuns::watch(const Caller& caller, const std::string& name,
                        const std::function<void(const runs::Run&)>& send) {
  runs::Run seen = get(name);
  send(seen);
  while (!is_over(seen.state)) {
    caller.require_wanted();
    std::this_thread::sleep_for(kReport);
    seen = await_change(caller, seen);
    send(seen);
  }
}

runs::Run MachineRuns::await_change(const Caller& caller, const runs::Run& seen) {
  for (auto looked = Clock::time_point::min();; std::this_thread::sleep_for(kLook)) {
    caller.require_wanted();
    auto now = find_live(seen.name);
    if (!now && Clock::now() >= looked + kDatabaseLook) {
      now = get_kept(seen.name);
      looked = Clock::now();
    }
    if (now && *now != seen) return *std::move(now);
  }
}

void MachineRuns::take_up(const Caller& caller, runs::Machine& machine, const std::string& name) {
  const auto known = open_run(name);
  if (!known) return machine.drop_run();
  Caller of_run = caller;
  of_run.identity = {.owner = name, .roles = {}};  // to which the plan belongs as well
  const jobs::PlanPointer plan = plans_.load(of_run, known->plan);
  const auto turn = machine.take_turn();
  if (machine.is_on(name)) return;     // its gateway attached once more, and was quicker
  const auto record = open_run(name);  // which may have been aborted meanwhile
  if (!record) return machine.drop_run();
  machine.take_up(decode_record(*record), plan);
  if (machine.has_open_run()) spdlog::info("{} goes on with {}", machine.profile().name, name);
}

std::optional<store::RunRecord> MachineRuns::open_run(const std::string& name) {
  auto record = archive_.find_run(name);
  if (record && record->state != store::RunRecordState::kOpen) record.reset();
  return record;
}

void MachineRuns::note(const runs::Machine& machine, std::optional<runs::Run>& seen) {
  const auto run = machine.run();
  if (!run) return;
  const bool is_news = !seen || seen->name != run->name || seen->state != run->state || seen->rate != run->rate ||
                       seen->controller != run->controller;
  if (!is_news) return;
  seen = run;
  ledger_.note(*run);
}

Machines::MachinePointer MachineRuns::require_control(const Caller& caller, const std::string& name, bool take_over) {
  Machines::MachinePointer machine = machines_.machine_of(name);
  const auto run = machine->run();
  if (!run || run->name != name) throw runs::NotNow(name + " is not what the machine is doing");
  if (run->controller != controller_of(caller)) {
    if (!take_over) {
      throw runs::NotNow(name + " is controlled by " + run->controller + ": ask for it with take_over");
    }
    machine->control(name, controller_of(caller));
  }
  return machine;
}

runs::Run MachineRuns::noted(const runs::Run& run) {
  ledger_.note(run);
  return run;
}

}  // namespace kcs::service
