// A motion as a drive sees it: where it is told to be, every millisecond.
#pragma once

#include <string>
#include <vector>

#include "server/motion/trajectory.h"
#include "server/planning/toolpath.h"

namespace kcs::bench {

inline constexpr double kPeriod = 0.001;  // s

using MotionRecord = std::vector<planning::Vector>;  // mm

// LinuxCNC's, from a file of lines "x y z". Throws std::runtime_error that names the file if it cannot be read or if
// the sampler could not keep up.
MotionRecord read_record(const std::string& file);

MotionRecord record_of(const motion::Trajectory& trajectory);

// The same measure for everybody.
struct Measures {
  double duration = 0;   // s, from the first setpoint that moves to the last
  double at_feed = 0;    // share of the duration at 99.5 % of the feed or more
  double deviation = 0;  // largest distance from the path, mm
};
Measures measure(const MotionRecord& record, double feed, const planning::Toolpath& path, double tolerance);

}  // namespace kcs::bench
