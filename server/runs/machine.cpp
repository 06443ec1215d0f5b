#include "server/runs/machine.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace kcs::runs {
namespace {

constexpr double kSamePlace = 1e-6;  // mm

std::string text_of(const motion::Vector& position, std::size_t axes) {
  std::string text;
  for (std::size_t i = 0; i < axes; ++i) {
    text += fmt::format("{}{}{}", i > 0 ? " " : "", "XYZ"[i], position[static_cast<Eigen::Index>(i)]);
  }
  return text;
}

// The first of a plan's limits that a machine does not have.
std::string excess(const motion::AxisLimits& plan, const motion::AxisLimits& machine) {
  if (plan.axes != machine.axes) return fmt::format("has {} axes, the machine {}", plan.axes, machine.axes);
  for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(plan.axes); ++i) {
    const auto beyond = [i](const motion::Vector& wanted, const motion::Vector& most) { return wanted[i] > most[i]; };
    const char* what = beyond(plan.velocity, machine.velocity)           ? "velocity"
                       : beyond(plan.acceleration, machine.acceleration) ? "acceleration"
                       : beyond(plan.jerk, machine.jerk)                 ? "jerk"
                                                                         : nullptr;
    if (what != nullptr) return fmt::format("was made for more {} of axis {} than the machine has", what, "XYZ"[i]);
  }
  return "";
}

}  // namespace

void Machine::report(const MachineReport& report) {
  const std::lock_guard lock(mutex_);
  if (feed_ && report.run == run_->name) {
    note_speed(report);
    if (report.refused_batches != report_.refused_batches && report.where.branch == resumed_branch_) {
      feed_->go_on_from(report.where);  // what it did not take is made again for where it is
    }
    feed_->update(report.where);
  }
  report_ = report;
  if (run_ && !is_over(run_->state)) follow(report);
  changed_.notify_all();
}

// Between two reports, by what the machine has played.
void Machine::note_speed(const MachineReport& report) {
  if (report.run != report_.run || report.where.played <= report_.where.played) {
    run_->feed = 0;
    return;
  }
  const double time = static_cast<double>(report.where.played - report_.where.played) * profile_.feed.batch.period;
  run_->feed = (report.position - report_.position).norm() / time;
}

void Machine::follow(const MachineReport& report) {
  run_->position = report.position;
  if (report.state == MachineState::kFault) return end_run(RunState::kFailed, report.fault);
  if (report.run != run_->name) {
    if (started_ && run_->abort_asked) return end_run(RunState::kAborted, "");  // it has dropped it, as it was told to
    if (started_) end_run(RunState::kFailed, "the machine's gateway was started anew and does not know of the run");
    if (!report.fault.empty()) end_run(RunState::kFailed, report.fault);
    return;
  }
  started_ = true;
  const auto& ends = report.where.ends;
  run_->buffered = static_cast<double>(ends.back().tick - std::min(ends.back().tick, report.where.played)) *
                   profile_.feed.batch.period;
  if (feed_) run_->plan_time = feed_->plan_time();
  if (report.run_finished) return end_run(RunState::kFinished, "");
  switch (report.state) {
    case MachineState::kRunning:
      run_->state = RunState::kRunning;
      run_->reason.clear();
      break;
    case MachineState::kStopping:
      run_->state = RunState::kStopping;
      break;
    case MachineState::kHeld:
    case MachineState::kReady:
      if (run_->abort_asked) return end_run(RunState::kAborted, "");
      // Ready for another run: it cannot begin this one, or go on with it.
      if (report.state == MachineState::kReady && !report.fault.empty())
        return end_run(RunState::kFailed, report.fault);
      if (run_->state == RunState::kWaiting && !has_refused_to_begin(report)) break;  // it has not begun yet
      run_->state = RunState::kHeld;
      run_->reason = report.fault;
      break;
    case MachineState::kSwitchedOff:
    case MachineState::kFault:
    case MachineState::kUnknown:
      end_run(RunState::kFailed, "the machine was switched off");
  }
}

// A machine that was resumed, or has not begun, is on the branch that it is to begin on. It has held where it stands if
// it has left that, or if it refused what it was to begin with and waits for somebody to resume it.
bool Machine::has_refused_to_begin(const MachineReport& report) const {
  if (report.where.branch != resumed_branch_) return true;
  return report.state == MachineState::kHeld && report.refused_batches != refused_before_;
}

// Of a run; but what is to be dropped is dropped, whatever else has come up since.
void Machine::forget_orders() {
  std::erase_if(orders_, [](const Order& order) {
    const auto* stop = std::get_if<StopOrder>(&order);
    return stop == nullptr || !stop->abort;
  });
}

void Machine::end_run(RunState state, std::string reason) {
  run_->state = state;
  run_->reason = std::move(reason);
  run_->buffered = 0;
  run_->feed = 0;
  if (state == RunState::kFinished) run_->plan_time = run_->cycle_time;
  feed_.reset();
  plan_.reset();
  forget_orders();
}

std::optional<Order> Machine::next_order(std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  const auto order = [this]() -> std::optional<Order> {
    if (!orders_.empty()) {
      Order first = std::move(orders_.front());
      orders_.pop_front();
      return first;
    }
    if (!feed_ || run_->abort_asked) return {};
    try {
      if (auto batch = feed_->next()) return BatchOrder{run_->name, *std::move(batch)};
    } catch (const std::runtime_error& no_way) {
      feed_->pause();
      run_->reason = no_way.what();
    }
    return {};
  };
  if (auto now = order()) return now;
  changed_.wait_for(lock, patience);
  return order();
}

void Machine::require_ready_for(const jobs::KeptPlan& plan) const {
  const std::lock_guard lock(mutex_);
  const std::size_t axes = profile_.limits.axes;
  if (run_ && !is_over(run_->state)) throw NotNow(run_->name + " is not over: abort it, or let it finish");
  if (report_.state != MachineState::kReady) {
    throw NotNow(profile_.name + " is not ready: switch it on, and reset its fault if it has one");
  }
  if (const std::string what = excess(plan.options.planning.limits, profile_.limits); !what.empty()) {
    throw NotNow(plan.name + " " + what + ": plan it with the machine's own profile");
  }
  if (plan.options.start_speed != 0 || plan.options.start_acceleration != 0 || plan.options.end_speed != 0) {
    throw NotNow(plan.name + " does not begin and end at rest");
  }
  if ((plan.plan.start - report_.position).head(static_cast<Eigen::Index>(axes)).norm() > kSamePlace) {
    throw NotNow(fmt::format("{} stands at {}, the plan begins at {}: go there first, or plan from where it stands",
                             profile_.name, text_of(report_.position, axes), text_of(plan.plan.start, axes)));
  }
}

void Machine::begin(Run run, PlanPointer plan) {
  const std::lock_guard lock(mutex_);
  set_run(std::move(run), std::move(plan));
  start_feed();
  changed_.notify_all();
}

void Machine::take_up(Run run, PlanPointer plan) {
  const std::lock_guard lock(mutex_);
  set_run(std::move(run), std::move(plan));
  started_ = true;
  go_on();
  changed_.notify_all();
}

void Machine::attach(const MachineReport& first) {
  const std::lock_guard lock(mutex_);
  report_ = first;
  if (run_ && !is_over(run_->state)) {
    go_on();
  } else if (run_ && first.run == run_->name) {
    orders_.emplace_back(StopOrder{.abort = true});  // it does not know yet that the run is over
  }
  changed_.notify_all();
}

void Machine::drop_run() {
  const std::lock_guard lock(mutex_);
  if (run_ && !is_over(run_->state)) return;  // begun since it attached: the order to drop would hit that one
  orders_.emplace_back(StopOrder{.abort = true});
  changed_.notify_all();
}

void Machine::set_run(Run run, PlanPointer plan) {
  run.cycle_time = plan->plan.summary.cycle_time;
  run_ = std::move(run);
  plan_ = std::move(plan);
}

// A run that the machine was on and knows no more is nowhere to go on with, and must not begin once more.
void Machine::go_on() {
  const bool forgotten = started_ && report_.run != run_->name;
  forgotten ? follow(report_) : start_feed();
}

void Machine::start_feed() {
  started_ = report_.run == run_->name;
  forget_orders();
  run_->state = run_->hold_asked ? RunState::kHeld : RunState::kWaiting;
  feed_.emplace(plan_->plan, plan_->options.planning.limits, profile_.feed);
  feed_->set_rate(run_->rate);
  resumed_branch_ = 0;
  refused_before_ = report_.refused_batches;
  if (!started_) {
    feed_->go_on_from({.ends = {BatchEnd{}}});
    orders_.emplace_back(StartOrder{run_->name, run_->plan, plan_->plan.start});
  } else {
    feed_->go_on_from(report_.where);
    resumed_branch_ = report_.where.branch;
    if (report_.state != MachineState::kRunning) {  // it stands until somebody resumes it
      feed_->pause();
      ++resumed_branch_;
    }
  }
  // What it was told before may not have come to it.
  if (run_->hold_asked || run_->abort_asked) {
    feed_->pause();
    orders_.emplace_back(StopOrder{.abort = run_->abort_asked});
  }
  if (started_) follow(report_);
}

Run Machine::hold(const std::string& name) {
  const std::lock_guard lock(mutex_);
  Run& run = require_open(name);
  if (run.state == RunState::kHeld) return run;
  run.hold_asked = true;
  orders_.emplace_back(StopOrder{});
  feed_->pause();
  if (run.state == RunState::kWaiting) run.state = RunState::kHeld;  // before it began
  return changed();
}

Run Machine::resume(const std::string& name) {
  const std::lock_guard lock(mutex_);
  Run& run = require_open(name);
  if (run.state != RunState::kHeld) throw NotNow(name + " is not held");
  if (report_.run == name) {
    feed_->go_on_from(report_.where);
    resumed_branch_ = report_.where.branch;
  } else {
    feed_->go_on_from({.ends = {BatchEnd{}}});
  }
  refused_before_ = report_.refused_batches;
  run.state = RunState::kWaiting;
  run.hold_asked = false;
  run.reason.clear();
  orders_.emplace_back(ResumeOrder{name, resumed_branch_});
  return changed();
}

Run Machine::abort(const std::string& name) {
  const std::lock_guard lock(mutex_);
  Run& run = require_open(name);
  run.abort_asked = true;
  feed_->pause();
  const bool rests = report_.run != name || report_.state == MachineState::kHeld;
  if (rests) end_run(RunState::kAborted, "");
  orders_.emplace_back(StopOrder{.abort = true});
  return changed();
}

Run Machine::set_rate(const std::string& name, double rate) {
  const std::lock_guard lock(mutex_);
  require_open(name).rate = rate;
  feed_->set_rate(rate);
  return changed();
}

Run Machine::control(const std::string& name, const std::string& controller) {
  const std::lock_guard lock(mutex_);
  require_open(name).controller = controller;
  return changed();
}

bool Machine::has_open_run() const {
  const std::lock_guard lock(mutex_);
  return run_ && !is_over(run_->state);
}

bool Machine::is_on(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  return run_ && run_->name == name;
}

std::optional<Run> Machine::run() const {
  const std::lock_guard lock(mutex_);
  return run_;
}

MachineReport Machine::last_report() const {
  const std::lock_guard lock(mutex_);
  return report_;
}

Run& Machine::require_open(const std::string& name) {
  if (!run_ || run_->name != name) throw NotNow(name + " is not what the machine is doing");
  if (is_over(run_->state)) throw NotNow(name + " is over");
  return *run_;
}

Run Machine::changed() {
  changed_.notify_all();
  return *run_;
}

}  // namespace kcs::runs
