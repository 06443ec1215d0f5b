// Judges a finished trajectory from its phases alone; it knows nothing of how they were planned.
#pragma once

#include <string>

#include "server/motion/course.h"
#include "server/motion/limits.h"
#include "server/motion/trajectory.h"

namespace kcs::motion {

// How far beyond a limit rounding may go, relative to the limit.
inline constexpr double kRoundingShare = 1e-9;

// What a trajectory reaches: from the exact extremes of its polynomials, not from samples.
struct Verification {
  Vector max_velocity = Vector::Zero();      // largest magnitude on each axis, mm/s
  Vector max_acceleration = Vector::Zero();  // mm/s²
  Vector max_jerk = Vector::Zero();          // mm/s³
  double max_feed = 0;                       // along the path, mm/s
  double max_contour_error = 0;              // mm
  std::string fault;                         // the first thing that is wrong, with its time and segment; empty: none

  bool passed() const { return fault.empty(); }
};

// Checks that the trajectory starts and ends at rest on the path's ends; that time, position, velocity and acceleration
// are continuous at every joint; that no axis exceeds a limit, the speed no feed (of any segment that a phase follows),
// and the contour error no tolerance (of every segment that a phase follows: the smallest counts); that the path is
// travelled in order and forward, comes as near to each corner as it must, and rests where and as long as it must.
// Linear in the number of phases and segments.
Verification verify(const Trajectory& trajectory, const Reference& reference, const AxisLimits& limits);

}  // namespace kcs::motion
