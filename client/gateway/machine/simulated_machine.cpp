#include "client/gateway/machine/simulated_machine.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "client/gateway/machine/clock_follower.h"
#include "client/gateway/periodic_timer.h"
#include "client/gateway/real_time.h"

namespace kcs::gateway {
namespace {

constexpr double kNanoseconds = 1e9;  // in a second

}  // namespace

SimulatedMachine::SimulatedMachine(kcs_player_memory& memory, const Vector& start_mm, double clock_drift_ppm,
                                   const Switches& switches, Trace& trace)
    : memory_(memory),
      switches_(switches),
      trace_(trace),
      origin_mm_(start_mm),
      drives_clock_(1 + clock_drift_ppm * 1e-6),
      table_(memory.profile.axes, Vector::Zero()) {
  if (!kcs_player_start(&player_, &memory_)) throw std::invalid_argument("the machine's limits are not sound");
  std::copy(start_mm.begin(), start_mm.end(), input_.actual_mm);
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

ClockFigures SimulatedMachine::finish() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
  return figures_;
}

void SimulatedMachine::run(const std::stop_token& stop) {
  const RealTime real_time;
  figures_.fifo = real_time.fifo();
  figures_.memory_locked = real_time.memory_locked();
  const double period = memory_.profile.period_s;
  const double period_ns = period * kNanoseconds;
  PeriodicTimer timer(period);
  ClockFollower follower(period_ns);
  for (double due_ns = period_ns; !stop.stop_requested(); due_ns += period_ns) {
    const std::int64_t late = timer.wait();
    figures_.lateness.record(late);
    if (static_cast<double>(late) > period_ns) figures_.late_ticks = ++late_ticks_;
    figures_.missed_periods = timer.missed();
    tick();
    const double ahead_ns = timer.elapsed_ns() * drives_clock_ - due_ns;
    figures_.out_of_step_us = std::max(figures_.out_of_step_us, std::abs(ahead_ns) / 1000);
    timer.shift(follower.shift_ns(ahead_ns));
  }
}

void SimulatedMachine::tick() {
  input_.enable = !switches_.is_on(Switches::kOff);
  input_.hold = switches_.is_on(Switches::kHold);
  input_.drive_fault = switches_.is_on(Switches::kDriveFault);
  kcs_player_tick(&player_, &input_, &output_);
  const Vector commanded(output_.command_mm[0], output_.command_mm[1], output_.command_mm[2]);
  const Vector actual = move_drives(commanded);
  std::copy(actual.begin(), actual.end(), input_.actual_mm);
  if (!trace_.put({commanded, actual, 0, false, monotonic_s()})) ++untraced_ticks_;
}

Vector SimulatedMachine::move_drives(const Vector& commanded_mm) {
  if (switches_.is_on(Switches::kStuck)) return {input_.actual_mm[0], input_.actual_mm[1], input_.actual_mm[2]};
  return table_.follow(commanded_mm - origin_mm_, memory_.profile.period_s) + origin_mm_;
}

}  // namespace kcs::gateway
