// The path as the planner sees it: straight legs and the joints between them.
#pragma once

#include <cstdint>
#include <vector>

#include "server/motion/phase.h"
#include "server/planning/options.h"
#include "server/planning/toolpath.h"

namespace kcs::planning {

// One or more segments that lie on a straight line and agree in feed and tolerance.
struct Leg {
  Vector start = Vector::Zero();      // mm
  Vector end = Vector::Zero();        // mm
  Vector direction = Vector::Zero();  // unit tangent
  double length = 0;                  // mm, > 0
  double tolerance = 0;               // mm, at its corners
  // What the axes and the program allow along the leg:
  double feed = 0;                // mm/s
  double acceleration = 0;        // mm/s²
  double jerk = 0;                // mm/s³
  motion::SegmentRange segments;  // counted without segments of no length
};

// The point between two legs, or the end of the last one.
struct Joint {
  bool stop = false;       // rest on the point exactly
  double dwell = 0;        // s
  std::uint32_t line = 0;  // of the segment that ends here
};

// A tool path without segments of no length, and its legs. joints[i] is where legs[i] ends.
struct LegPath {
  double initial_dwell = 0;  // s, before anything moves
  std::vector<Leg> legs;
  std::vector<Joint> joints;  // as many as legs; the last one is the end of the path
  // Segment by segment, for the verifier:
  std::vector<Vector> points;      // mm; one more than segments
  std::vector<double> feeds;       // mm/s, as programmed
  std::vector<double> tolerances;  // mm
  std::vector<double> rests;       // s, at the segment's end; negative: no rest
};

// What the axes allow along `direction`: the smallest limit_i / |direction_i|; +infinity for a zero vector.
double along(const Vector& limit, const Vector& direction, std::size_t axes);

// Breaks a path into legs. Its numbers must be valid (validation.h).
LegPath legs_of(const Toolpath& path, const AxisLimits& limits);

}  // namespace kcs::planning
