// The path as the planner sees it: straight legs and the joints between them.
#pragma once

#include <cstdint>
#include <vector>

#include "server/motion/phase.h"
#include "server/planning/options.h"

namespace kcs::planning {

// One or more segments that lie on a straight line and agree in feed and tolerance.
struct Leg {
  Vector start = Vector::Zero();      // mm
  Vector end = Vector::Zero();        // mm
  Vector direction = Vector::Zero();  // unit tangent
  double length = 0;                  // mm, > 0
  double tolerance = 0;               // mm, at its corners
  double programmed_feed = 0;         // mm/s
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

// Legs that follow each other: joints[i] is where legs[i] ends.
struct LegPath {
  std::vector<Leg> legs;
  std::vector<Joint> joints;
};

// What the axes allow along `direction`: the smallest limit_i / |direction_i|; +infinity for a zero vector.
double along(const Vector& limit, const Vector& direction, std::size_t axes);

// The same, but no more than the greatest limit of an axis: for estimates, which need not know that along a diagonal
// axes allow more together, but must not count an axis that hardly moves.
double roughly_along(const Vector& limit, const Vector& direction, std::size_t axes);

}  // namespace kcs::planning
