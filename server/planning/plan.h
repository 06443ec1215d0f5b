// A planned tool path: the trajectory, how each corner is taken, and the figures that people ask for.
#pragma once

#include <cstddef>
#include <vector>

#include "server/motion/path.h"
#include "server/motion/progress.h"
#include "server/motion/trajectory.h"
#include "server/planning/corner_list.h"
#include "server/planning/marker.h"

namespace kcs::planning {

struct Summary {
  double cycle_time = 0;        // s
  double path_length = 0;       // mm
  std::size_t segments = 0;     // segments of no length not counted
  std::size_t interrupted = 0;  // corners by strategy
  std::size_t uninterrupted = 0;
  std::size_t blended = 0;
  std::size_t overlapping = 0;
  std::size_t exact_stops = 0;
  std::size_t markers = 0;
  double time_lost_at_corners = 0;  // s
  double dwell_time = 0;            // s
  double time_at_feed = 0;          // s
  // From the verifier:
  Vector max_velocity = Vector::Zero();      // mm/s
  Vector max_acceleration = Vector::Zero();  // mm/s²
  Vector max_jerk = Vector::Zero();          // mm/s³
  double max_feed = 0;                       // mm/s
  double max_contour_error = 0;              // mm
};

struct Plan {
  Vector start = Vector::Zero();  // mm
  motion::Trajectory trajectory;
  // The path that it follows, segments of no length left out, and how far along it the motion is when.
  motion::Path path;
  std::vector<motion::Milestone> milestones;
  CornerList corners;             // in the order of the path
  std::vector<MarkerAt> markers;  // likewise
  Summary summary;
};

}  // namespace kcs::planning
