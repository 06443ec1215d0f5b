// How much the pace may change at a place of a plan.
#pragma once

#include "server/motion/limits.h"
#include "server/runs/clock.h"
#include "server/runs/plan_window.h"

namespace kcs::runs {

// What ClockPhase::bend may be.
struct BendRange {
  double low, high;  // 1/s²

  bool empty() const { return low > high; }
};

// The bends that keep every axis inside its limits for `step` seconds from `state` on: to first order in the step, so
// that what is made of them needs a verification. share: of the limits to be used, where the plan at this rate does not
// use more by itself. most: what they may be where nothing moves, 1/s².
//
// Along the plan q(s) with s' = rate r, s'' = u and s''' = k the motion has
//   velocity q' r, acceleration q'' r² + q' u, jerk q''' r³ + 3 q'' r u + q' k.
BendRange bend_range(PlanWindow& plan, const motion::AxisLimits& limits, const ClockState& state, double step,
                     double share, double most);

}  // namespace kcs::runs
