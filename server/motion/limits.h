// What the axes of a machine can do.
#pragma once

#include <cstddef>

#include "server/motion/phase.h"

namespace kcs::motion {

// Largest magnitudes on each axis. The entries of an axis that the machine does not have are not read.
struct AxisLimits {
  std::size_t axes = 3;                  // 2 or 3
  Vector velocity = Vector::Zero();      // mm/s
  Vector acceleration = Vector::Zero();  // mm/s²
  Vector jerk = Vector::Zero();          // mm/s³

  bool operator==(const AxisLimits&) const = default;
};

}  // namespace kcs::motion
