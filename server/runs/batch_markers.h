// What a batch switches.
#pragma once

#include <cstddef>
#include <vector>

#include "server/planning/marker.h"

namespace kcs::runs {

// In one batch, at the most: the contract's number.
inline constexpr std::size_t kMostMarkers = 16;

struct BatchMarker {
  std::size_t setpoint = 0;  // of the batch, and then of its tail, with which it comes
  planning::Marker marker;
};

// The course of a batch and of its tail, as markers see it.
struct MarkedCourse {
  double from = 0;            // s, the plan's time where it begins
  std::vector<double> times;  // s, the plan's time at each setpoint, never falling
  std::size_t setpoints = 0;  // of the batch; those after them are the tail's
  bool to_end = false;        // the last setpoint is the end of the plan
};

// The markers of a plan, in order of time, that are due on this way: each comes with the first setpoint beyond it,
// those at the very end of the plan with its last one. So a marker is in no two batches that follow each other, and in
// none that goes on where a tail ended that had it. If they are more than kMostMarkers, those that a later one in the
// batch makes void are left out, and likewise in the tail.
std::vector<BatchMarker> markers_on(const MarkedCourse& course, const std::vector<planning::MarkerAt>& markers);

}  // namespace kcs::runs
