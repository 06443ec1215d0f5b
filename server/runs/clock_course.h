// How a plan's clock goes on for a while.
#pragma once

#include <vector>

#include "server/runs/clock.h"

namespace kcs::runs {

// Stretches of time, one after the other.
class ClockCourse {
 public:
  explicit ClockCourse(const ClockState& start) : end_(start) {}

  // Goes on with a stretch that begins where in the plan the course ends. end: the state to go on from after it, which
  // is its end without what rounding leaves of it, or in a dwell has another rate.
  void add(const ClockPhase& stretch, const ClockState& end);

  // Takes off what lies beyond `duration` (s).
  ClockCourse cut(double duration);

  const std::vector<ClockPhase>& stretches() const { return stretches_; }
  const ClockState& end() const { return end_; }
  double duration() const { return duration_; }  // s

 private:
  std::vector<ClockPhase> stretches_;
  ClockState end_;
  double duration_ = 0;
};

}  // namespace kcs::runs
