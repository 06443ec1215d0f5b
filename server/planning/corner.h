// How a corner of a tool path is taken, and what it costs.
#pragma once

#include <cstddef>
#include <cstdint>

#include "server/planning/options.h"

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

}  // namespace kcs::planning
