// What a plan is asked to keep to.
#pragma once

#include <stop_token>

#include "server/motion/limits.h"
#include "server/planning/range.h"

namespace kcs::planning {

using motion::AxisLimits;
using motion::Vector;

// What a tolerance limits at a corner.
enum class ToleranceKind {
  // The largest distance from the smoothed curve to the programmed path. At a symmetric corner that is
  // ε·cos(θ2/2), so the corner may be cut deeper than the tolerance.
  kContourError,
  // The distance from the programmed corner to the middle of the smoothed corner (the paper's ε).
  kCornerDistance,
};

// How corners are taken (Tajima and Sencer 2016).
enum class CornerStrategy {
  kAuto,           // the fastest of the others, for each corner
  kInterrupted,    // section 2.2: no acceleration where the corner begins and ends
  kUninterrupted,  // section 2.3: brakes into the corner, accelerates out of it
  kExactStop,      // rests on the corner point
  kBlended,        // between the paper's two, see blended.h
  kOverlapping,    // one of many in one smooth motion, see stretch.h; is never asked for
};

// What counts where cycle time can be had for planning time.
enum class Effort {
  kFull,   // the path is short, and this is all of it: cycle time
  kUsual,  // this is one of many parts: both; up to 1 % of the cycle time is given for up to two thirds of the work
  kLeast,  // the machine waits for this part: what is found sooner and is nearly as fast will do
};

struct PlanOptions {
  AxisLimits limits;
  ToleranceKind tolerance_kind = ToleranceKind::kContourError;
  CornerStrategy strategy = CornerStrategy::kAuto;
  // How to say that nobody wants the plan any more: planning then throws Stopped (stopped.h), within some milliseconds.
  // No part of what is asked for.
  std::stop_token stop;
  // No part of what is asked for.
  Effort effort = Effort::kFull;
};

}  // namespace kcs::planning
