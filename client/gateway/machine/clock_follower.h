// Keeps the ticks in step with the drives' own clock.
#pragma once

#include <algorithm>

namespace kcs::gateway {

// The drives take one setpoint each period of their own clock, which runs a little faster or slower than the
// computer's. Ticking by the computer's clock alone would have to drop or repeat a setpoint in the end, which is a
// jump. So the deadlines are shifted little by little instead, as by a phase-locked loop: proportional to how far the
// drives are ahead, and to the sum of that, which finds the difference of the clocks. Critically damped; settles within
// some 1000 ticks.
class ClockFollower {
 public:
  // period_ns: of the ticks, > 0.
  explicit ClockFollower(double period_ns) : most_(period_ns * kMostShare) {}

  // After each tick. ahead_ns: how much of the drives' time has gone by beyond what the ticks so far have given them.
  // Returns by how much to shift the next deadline, ns: at most a hundredth of a period.
  double shift_ns(double ahead_ns) {
    sum_ += ahead_ns;
    return std::clamp(-kProportional * ahead_ns - kIntegral * sum_, -most_, most_);
  }

 private:
  static constexpr double kMostShare = 0.01;
  static constexpr double kProportional = 0.01;
  static constexpr double kIntegral = kProportional * kProportional / 4;

  double most_;     // ns
  double sum_ = 0;  // ns
};

}  // namespace kcs::gateway
