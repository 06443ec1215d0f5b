// A machine that a gateway has attached, and the run that it is on.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <variant>

#include "server/jobs/plan_request.h"
#include "server/runs/not_now.h"
#include "server/runs/run.h"
#include "server/runs/run_feed.h"

namespace kcs::runs {

// What a gateway says of its machine when it attaches.
struct MachineProfile {
  std::string name;  // "machines/NAME"
  motion::AxisLimits limits;
  FeedOptions feed;

  bool operator==(const MachineProfile&) const = default;
};

enum class MachineState { kUnknown, kSwitchedOff, kReady, kRunning, kStopping, kHeld, kFault };

// What it says from then on.
struct MachineReport {
  MachineState state = MachineState::kUnknown;
  motion::Vector position = motion::Vector::Zero();  // commanded, mm
  motion::Vector actual = motion::Vector::Zero();    // mm
  std::string run;                                   // empty: none
  MachinePosition where;                             // in the run, if there is one
  std::string fault;
  std::uint64_t starvations = 0, refused_batches = 0;
  bool run_finished = false;
};

// What a gateway is to do next.
struct StartOrder {
  std::string run, plan;
  motion::Vector position;  // mm, where the plan begins
};
struct StopOrder {
  bool abort = false;
};
struct ResumeOrder {
  std::string run;
  std::uint64_t branch = 0;
};
struct BatchOrder {
  std::string run;
  NumberedBatch batch;
};
using Order = std::variant<StartOrder, StopOrder, ResumeOrder, BatchOrder>;

// Safe for use by many threads at once: the gateway's call reports and takes orders, everybody else controls.
class Machine {
 public:
  using PlanPointer = jobs::PlanPointer;

  explicit Machine(MachineProfile profile) : profile_(std::move(profile)) {}

  const MachineProfile& profile() const { return profile_; }

  // For the gateway's call: the first report after it was attached, and each one after that.
  void attach(const MachineReport& first);
  void report(const MachineReport& report);
  // The next order; nothing if none came up for `patience`.
  std::optional<Order> next_order(std::chrono::milliseconds patience);

  // For whoever decides which run it is on: one at a time, from the first look until it is begun. What is asked of a
  // run that it is on waits for nobody.
  std::unique_lock<std::mutex> take_turn() { return std::unique_lock(turn_); }
  // Whether a run of this plan could begin: throws NotNow.
  void require_ready_for(const jobs::KeptPlan& plan) const;
  void begin(Run run, PlanPointer plan);
  // Goes on with one that the machine has said that it is on, where it is.
  void take_up(Run run, PlanPointer plan);
  // The machine attached with a run that is over, or that nobody knows: it is to forget it. Nothing if another one has
  // begun since.
  void drop_run();
  // Each returns the run as it is then; throws NotNow unless the machine is on this run and it can be done.
  Run hold(const std::string& run);
  Run resume(const std::string& run);
  Run abort(const std::string& run);
  Run set_rate(const std::string& run, double rate);
  Run control(const std::string& run, const std::string& controller);

  bool has_open_run() const;
  // Whether it is on this run, or was on it last.
  bool is_on(const std::string& run) const;
  // The run that it is on or was on last.
  std::optional<Run> run() const;
  MachineReport last_report() const;

 private:
  Run& require_open(const std::string& run);
  Run changed();
  void set_run(Run run, PlanPointer plan);
  void go_on();
  void start_feed();
  void note_speed(const MachineReport& report);
  void follow(const MachineReport& report);
  bool has_refused_to_begin(const MachineReport& report) const;
  void forget_orders();
  void end_run(RunState state, std::string reason);

  const MachineProfile profile_;
  std::mutex turn_;  // before mutex_
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  MachineReport report_;
  std::optional<Run> run_;
  PlanPointer plan_;             // of the run, while it is open
  std::optional<RunFeed> feed_;  // likewise
  std::deque<Order> orders_;     // before any batch
  bool started_ = false;         // the machine has said that it is on the run
  std::uint64_t resumed_branch_ = 0;
  std::uint64_t refused_before_ = 0;  // batches, when it was resumed or begun
};

}  // namespace kcs::runs
