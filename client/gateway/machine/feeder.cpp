#include "client/gateway/machine/feeder.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

#include "client/gateway/machine/words.h"

namespace kcs::gateway {
namespace {

// How far from the start of its plan a machine may stand: what rounding can do, and too little to be a jump.
constexpr double kSamePlace = 1e-9;  // mm

std::string run_name(const std::string& machine, std::uint64_t number) {
  return fmt::format("{}/runs/{}", machine, number);
}

// The number of a run of this machine; 0 if it is none.
std::uint64_t run_number(std::string_view name, const std::string& machine) {
  const std::string prefix = machine + "/runs/";
  if (!name.starts_with(prefix)) return 0;
  name.remove_prefix(prefix.size());
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  return error == std::errc() && end == name.data() + name.size() ? number : 0;
}

bool moves(const kcs_player_report& report) {
  return report.state == KCS_PLAYER_RUNNING || report.state == KCS_PLAYER_STOPPING;
}

bool is_on(const kcs_player_report& report) {
  return report.state != KCS_PLAYER_OFF && report.state != KCS_PLAYER_FAULT;
}

}  // namespace

Feeder::Feeder(kcs_player_memory& player, FeederOptions options, std::shared_ptr<spdlog::logger> log)
    : player_(player),
      options_(std::move(options)),
      log_(std::move(log)),
      stops_asked_(player.stop_requests),
      staging_(player.profile.axes, player.profile.period_s, options_.commit_s) {
  if (kcs_player_read(&player_, &player_report_)) adopt();
}

void Feeder::adopt() {
  if (player_report_.run == 0) return;
  run_ = Run{.name = run_name(options_.machine, player_report_.run)};
  staging_.adopt(player_report_);
  if (player_report_.state == KCS_PLAYER_RUNNING) stop();
  log_->warn("found a run run={} played={} branch={}", run_->name, player_report_.played, player_report_.branch);
}

void Feeder::take(const v1::AttachMachineResponse& order) {
  const std::lock_guard lock(mutex_);
  switch (order.content_case()) {
    case v1::AttachMachineResponse::kStart:
      return start(order.start());
    case v1::AttachMachineResponse::kBatch:
      return take(order.batch());
    case v1::AttachMachineResponse::kCommand:
      return take(order.command());
    case v1::AttachMachineResponse::kResume:
      return resume(order.resume());
    case v1::AttachMachineResponse::CONTENT_NOT_SET:
      return;  // a sign of life
    default:
      log_->warn("the server sent something that this gateway does not know; is it of a later version?");
  }
}

std::optional<std::string> Feeder::find_obstacle(const v1::Run& run) const {
  if (shut_down_) return "the gateway is being stopped";
  if (run_number(run.name(), options_.machine) == 0) {
    return fmt::format("\"{}\" is no run of {}", run.name(), options_.machine);
  }
  if (!is_on(player_report_)) return "the drives are off, or in fault; switch the machine on";
  if (moves(player_report_)) return "the machine moves";
  if (run_number(run.name(), options_.machine) == player_report_.run) {
    return "the machine has played a run of that number already; a new one needs a new number";
  }
  const auto axes = static_cast<int>(player_.profile.axes);
  if (run.position_mm_size() != axes) {
    return fmt::format("the start has {} coordinates for {} axes", run.position_mm_size(), axes);
  }
  for (int axis = 0; axis < axes; ++axis) {
    const double stands = player_report_.command_mm[axis];
    if (std::abs(run.position_mm(axis) - stands) <= kSamePlace) continue;
    return fmt::format("the machine stands at {:.9g} mm on axis {}, and the plan starts at {:.9g} mm", stands,
                       "XYZ"[axis], run.position_mm(axis));
  }
  return std::nullopt;
}

void Feeder::start(const v1::Run& run) {
  // Of a run that another gateway began, the plan is not known here.
  const bool same_plan = run_ && (run_->plan.empty() || run_->plan == run.plan());
  const bool said_twice = run_ && run_->name == run.name() && same_plan && run_->phase != Phase::kDead;
  if (said_twice) return;
  ++revision_;
  const auto obstacle = find_obstacle(run);
  if (obstacle && run_ && run_->phase != Phase::kDead && moves(player_report_)) {
    log_->warn("refused a run run={} under_way={} reason={:?}", run.name(), run_->name, *obstacle);
    return;
  }
  run_ = Run{run.name(), run.plan()};
  fault_.clear();
  staging_.begin(run_number(run.name(), options_.machine), run.plan_time_s());
  if (obstacle) return fail(*obstacle);
  log_->info("run begins run={} plan={}", run.name(), run.plan());
}

void Feeder::take(const v1::MotionBatch& batch) {
  // One that was on its way when the run was held, or ended.
  if (!run_ || batch.run() != run_->name || run_->phase != Phase::kOpen || is_finished()) return;
  const StagingResult result = staging_.stage(batch);
  if (result.staged == Staged::kRefused) {
    ++refused_batches_;
    ++revision_;
    if (!refusing_) log_->warn("refused a batch tick={} reason={:?}", batch.first_tick(), result.reason);
  }
  refusing_ = result.staged == Staged::kRefused;
}

void Feeder::take(v1::MachineCommand command) {
  log_->info("command {}", v1::MachineCommand_Name(command));
  if (command != v1::MACHINE_COMMAND_HOLD && command != v1::MACHINE_COMMAND_ABORT) return;
  ++revision_;
  stop();
  if (!run_) return;
  if (command == v1::MACHINE_COMMAND_ABORT) {
    run_->phase = Phase::kAborting;
  } else if (run_->phase == Phase::kOpen) {
    run_->phase = Phase::kHolding;
  }
}

void Feeder::resume(const v1::ResumeOrder& order) {
  if (!run_ || order.run() != run_->name || run_->phase != Phase::kHolding) return;
  ++revision_;
  run_->phase = Phase::kOpen;
  log_->info("resumed run={} branch={}", run_->name, order.branch());
}

void Feeder::stop() {
  kcs_player_ask_to_stop(&player_);
  ++stops_asked_;
  staging_.clear();
}

bool Feeder::stop_is_under_way() const { return player_report_.stops_obeyed != stops_asked_; }

void Feeder::step() {
  const std::lock_guard lock(mutex_);
  if (!kcs_player_read(&player_, &player_report_)) return;  // the next step sees it
  follow();
  if (run_ && run_->phase == Phase::kOpen && !shut_down_ && is_on(player_report_) && !stop_is_under_way()) {
    staging_.commit(player_);
  }
  note_state();
}

void Feeder::follow() {
  if (!run_) return;
  const bool begun = run_number(run_->name, options_.machine) == player_report_.run;
  const bool stopped_before_it_began = !begun && run_->phase != Phase::kOpen && !stop_is_under_way();
  if (stopped_before_it_began) staging_.go_back();
  follow_run(staging_.follow(player_report_));
  if (run_->phase == Phase::kAborting && !moves(player_report_) && !stop_is_under_way()) {
    log_->info("run aborted run={}", run_->name);
    run_.reset();
    fault_.clear();
  }
}

void Feeder::follow_run(bool left) {
  const bool goes_well = player_report_.reason == KCS_PLAYER_NONE || player_report_.reason == KCS_PLAYER_END;
  if (goes_well && run_->phase != Phase::kDead) fault_.clear();
  const bool over = run_->phase == Phase::kDead || run_->phase == Phase::kAborting || is_finished();
  if (!is_on(player_report_)) {
    const bool fault = player_report_.state == KCS_PLAYER_FAULT;
    if (!over) fail(fault ? std::string(describe_reason(player_report_.reason)) : "the machine was switched off");
    return;
  }
  if (!left) return;
  ++revision_;
  if (player_report_.reason == KCS_PLAYER_ASKED || player_report_.reason == KCS_PLAYER_NONE) return;
  fault_ = describe_reason(player_report_.reason);
  log_->warn("left the stream run={} branch={} played={} reason={:?}", run_->name, staging_.branch(),
             player_report_.played, fault_);
  // One that the player will not begin with would be sent again and again: that is for the operator to decide.
  if (!moves(player_report_) && run_->phase == Phase::kOpen && player_report_.reason != KCS_PLAYER_STARVED) {
    run_->phase = Phase::kHolding;
  }
}

void Feeder::fail(const std::string& why) {
  run_->phase = Phase::kDead;
  staging_.clear();
  fault_ = why;
  ++revision_;
  log_->error("run cannot go on run={} reason={:?}", run_->name, why);
}

bool Feeder::is_finished() const {
  return run_ && run_->phase != Phase::kDead && player_report_.reason == KCS_PLAYER_END &&
         player_report_.run == run_number(run_->name, options_.machine);
}

v1::MachineState Feeder::state() const {
  const v1::MachineState player = to_message(player_report_.state);
  const bool rests = player == v1::MACHINE_STATE_READY || player == v1::MACHINE_STATE_HELD;
  if (!rests) return player;
  const bool held = run_ && !is_finished() && (player == v1::MACHINE_STATE_HELD || run_->phase == Phase::kHolding);
  const bool open = run_ && run_->phase != Phase::kDead;
  return held && open ? v1::MACHINE_STATE_HELD : v1::MACHINE_STATE_READY;
}

void Feeder::note_state() {
  const v1::MachineState now = state();
  if (now == reported_state_) return;
  log_->info("state {} was={} reason={:?}", name_of(now), name_of(reported_state_),
             describe_reason(player_report_.reason));
  reported_state_ = now;
  ++revision_;
}

v1::MachineReport Feeder::report() const {
  const std::lock_guard lock(mutex_);
  v1::MachineReport report;
  report.set_state(state());
  for (std::uint32_t axis = 0; axis < player_.profile.axes; ++axis) {
    report.add_position_mm(player_report_.command_mm[axis]);
    report.add_actual_mm(player_report_.actual_mm[axis]);
    report.mutable_counters()->add_largest_following_error_mm(player_report_.largest_following_error_mm[axis]);
  }
  report.mutable_counters()->set_starvations(player_report_.starvations);
  report.mutable_counters()->set_refused_batches(refused_batches_ + player_report_.refused);
  report.mutable_counters()->set_late_ticks(options_.late_ticks());
  report.set_fault(fault_);
  if (run_) {
    *report.mutable_run() = staging_.position();
    report.mutable_run()->set_run(run_->name);
    report.set_run_finished(is_finished());
  }
  return report;
}

std::uint64_t Feeder::revision() const {
  const std::lock_guard lock(mutex_);
  return revision_;
}

bool Feeder::has_run() const {
  const std::lock_guard lock(mutex_);
  return run_.has_value() && !is_finished();
}

void Feeder::shut_down() {
  const std::lock_guard lock(mutex_);
  shut_down_ = true;
  stop();
}

bool Feeder::at_rest() const {
  const std::lock_guard lock(mutex_);
  return !moves(player_report_) && !stop_is_under_way();
}

}  // namespace kcs::gateway
