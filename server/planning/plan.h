// A planned tool path: the trajectory, how each corner is taken, and the figures that people ask for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "server/motion/trajectory.h"
#include "server/planning/options.h"
#include "server/planning/toolpath.h"

namespace kcs::planning {

// A joint of the path at which the direction changes or the tool stops.
struct Corner {
  std::size_t segment = 0;        // that ends here; index into Toolpath::segments, segments of no length not counted
  std::uint32_t line = 0;         // of that segment
  Vector point = Vector::Zero();  // mm
  double angle = 0;               // direction change, rad, 0 to π
  CornerStrategy strategy = CornerStrategy::kExactStop;  // never kAuto
  double speed = 0;                                      // where it begins and ends, mm/s; kOverlapping: at its middle
  double boundary_acceleration = 0;                      // there, along the path, magnitude, mm/s²
  double duration = 0;                                   // inside the corner, dwell included, s
  double dwell = 0;                                      // s
  double corner_distance = 0;                            // corner point to the middle of the smoothed corner,
                                                         // or to where the tool is nearest (kOverlapping), mm
  double contour_error = 0;                              // smoothed corner to programmed path, mm
  double time_lost = 0;                                  // s, see Corner.time_lost_s of the contract
};

struct Summary {
  double cycle_time = 0;        // s
  double path_length = 0;       // mm
  std::size_t segments = 0;     // segments of no length not counted
  std::size_t interrupted = 0;  // corners by strategy
  std::size_t uninterrupted = 0;
  std::size_t blended = 0;
  std::size_t overlapping = 0;
  std::size_t exact_stops = 0;
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
  std::vector<Corner> corners;  // in the order of the path
  Summary summary;
};

}  // namespace kcs::planning
