// The two sides of a corner: the outgoing leg, and the incoming one, which is its mirror image backwards in time.
#pragma once

#include "server/motion/phase.h"
#include "server/planning/corner_geometry.h"
#include "server/planning/half_corner.h"

namespace kcs::planning {

struct CornerSide {
  Vector corner;         // the corner point, mm
  Vector away;           // unit vector along the leg, away from the corner
  Vector across;         // unit vector square to it, to the inside of the corner
  double direction = 1;  // of time: −1 on the incoming leg

  // What the axes allow across the leg while `used` goes along it, one way or the other: the smallest
  // (limit_i − used·|away_i|)/|across_i|. In the unit of `limit`; negative if `used` is too much.
  double left_across(const Vector& limit, double used, std::size_t axes) const;

  // What they allow along the leg while `used` goes across it.
  double left_along(const Vector& limit, double used, std::size_t axes) const;

  motion::State state(const HalfState& half) const;
  Vector jerk(const HalfPhase& phase) const { return direction * (phase.along * away + phase.across * across); }
};

struct CornerSides {
  // Neither straight on nor a reversal: the corner has a plane.
  explicit CornerSides(const CornerGeometry& corner);

  CornerSide in, out;
};

}  // namespace kcs::planning
