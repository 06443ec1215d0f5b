// How fast the tool is, place by place.
#pragma once

#include <cstddef>
#include <vector>

#include "server/motion/trajectory.h"
#include "server/planning/toolpath.h"

namespace kcs::bench {

struct SpeedSample {
  double length = 0;  // along the tool path, mm
  double speed = 0;   // mm/s
  std::size_t segment = 0;
};

// The trajectory follows the path as near as `tolerance` (mm). Samples follow each other so closely that even one of
// the shortest segments that matter to a machine has several.
std::vector<SpeedSample> speed_samples(const motion::Trajectory& trajectory, const planning::Toolpath& path,
                                       double tolerance);

}  // namespace kcs::bench
