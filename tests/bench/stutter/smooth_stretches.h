// Where a tool path is a curve that was cut into short lines.
#pragma once

#include <cstddef>
#include <vector>

#include "server/planning/toolpath.h"

namespace kcs::bench {

// What a segment belongs to.
struct Stretch {
  std::size_t first = 0, last = 0;  // segments of the same smooth curve; first > last: none
  double allowed = 0;               // mm/s: what the curve around the segment allows, whatever the feed

  bool smooth() const { return first <= last; }
};

// One for each segment of the path. A curve is smooth as long as it turns by at most 15° from segment to segment and
// as much, and the same way, as at the joint before: the curvatures differ by less than half of the greater one, or the
// turns by less than 2° (for the rounding in programs). It has at least five segments.
// The curvature c allows a speed v with v² c = acceleration, and its change c' along the curve one with v³ c' = jerk
// (of every axis, mm/s² and mm/s³).
std::vector<Stretch> smooth_stretches(const planning::Toolpath& path, double acceleration, double jerk);

}  // namespace kcs::bench
