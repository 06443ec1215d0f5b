// Runs as callers know them: begun, controlled, watched, taken up again.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "server/runs/run.h"
#include "server/service/caller.h"
#include "server/service/machines.h"
#include "server/service/plans.h"
#include "server/service/run_ledger.h"

namespace kcs::service {

// Joins the machines, the plans, and the store, where it is written down which machine is on which run: a machine that
// comes back, to this server or another one, is given the rest of its run. Every method throws what
// end_by_current_exception() knows (status.h). Safe for use by many threads at once.
class MachineRuns {
 public:
  // Keeps references to all of them.
  MachineRuns(Machines& machines, Plans& plans, Archive& archive)
      : machines_(machines), plans_(plans), archive_(archive), ledger_(archive) {}

  // Whoever begins a run controls it.
  runs::Run begin(const Caller& caller, const std::string& machine, const std::string& plan, double rate);
  runs::Run get(const std::string& run);
  runs::Run hold(const std::string& run);
  runs::Run resume(const Caller& caller, const std::string& run, bool take_over);
  runs::Run abort(const std::string& run);
  runs::Run set_rate(const Caller& caller, const std::string& run, double rate, bool take_over);
  // Hands what changes to `send`, until the run is over.
  void watch(const Caller& caller, const std::string& run, const std::function<void(const runs::Run&)>& send);

  // A machine that has just been attached says that it is on a run: gives it the rest, or tells it that the run is
  // over. May take as long as planning; the caller is asked all the while whether it is still wanted.
  void take_up(const Caller& caller, runs::Machine& machine, const std::string& run);
  // Takes note of how a machine's run goes, for the store. seen: as it was noted last.
  void note(const runs::Machine& machine, std::optional<runs::Run>& seen);

 private:
  // The machine that is on the run, if the caller may control it.
  Machines::MachinePointer require_control(const Caller& caller, const std::string& run, bool take_over);
  // As its machine knows it; nothing if that is not attached, or not on it.
  std::optional<runs::Run> find_live(const std::string& run) const;
  runs::Run get_kept(const std::string& run);
  runs::Run await_change(const Caller& caller, const runs::Run& seen);
  // As it is kept; nothing if it is over, or not kept.
  std::optional<store::RunRecord> open_run(const std::string& run);
  // A run that its machine, which is attached, is not on.
  runs::Run close(store::RunRecord record, store::RunRecordState state);
  runs::Run noted(const runs::Run& run);

  Machines& machines_;
  Plans& plans_;
  Archive& archive_;
  RunLedger ledger_;
};

}  // namespace kcs::service
