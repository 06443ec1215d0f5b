// How near a corner comes to the limits.
#pragma once

#include "server/planning/corner_geometry.h"
#include "server/planning/corner_sides.h"
#include "server/planning/half_corner.h"

namespace kcs::planning {

// Against the limits: ≤ 1 is inside.
struct Strain {
  double acceleration = 0;  // of the axis that has least left
  double speed = 0;         // in the turn
};

// Of a corner whose second half begins in `start` with constant acceleration before it, exactly.
Strain strain_of(const CornerGeometry& corner, const CornerSides& sides, const AxisLimits& limits,
                 const HalfState& start, const HalfCorner& half);

}  // namespace kcs::planning
