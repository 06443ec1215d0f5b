#include "server/planning/corner_strain.h"

#include <algorithm>

namespace kcs::planning {
namespace {

double largest_share(const Vector& of, const AxisLimits& limits) {
  double largest = 0;
  for (std::size_t axis = 0; axis < limits.axes; ++axis) {
    largest = std::max(largest, std::abs(of[axis]) / limits.acceleration[axis]);
  }
  return largest;
}

}  // namespace

Strain strain_of(const CornerGeometry& corner, const CornerSides& sides, const AxisLimits& limits,
                 const HalfState& start, const HalfCorner& half) {
  // The part square to the bisector.
  const auto onward = [&](double along, double across) {
    return along * corner.half_cosine - across * corner.half_sine;
  };
  const double feed = std::min(corner.in.feed, corner.out.feed);
  Strain strain;
  const auto look_at = [&](const HalfState& state) {
    for (const CornerSide* side : {&sides.in, &sides.out}) {
      strain.acceleration = std::max(strain.acceleration, largest_share(side->state(state).acceleration, limits));
    }
    // In the turn the velocity is x·ts + y·te, x and y ≥ 0: with x + y at most the feed no axis is too fast either.
    const double x_and_y = onward(state.along.velocity, state.across.velocity) / corner.half_cosine;
    strain.speed = std::max(strain.speed, x_and_y / feed);
  };

  HalfState state = start;
  look_at(state);
  for (const HalfPhase& phase : half.phases()) {
    const double acceleration = onward(state.along.acceleration, state.across.acceleration);
    const double jerk = onward(phase.along, phase.across);
    if (acceleration > 0 && acceleration + jerk * phase.duration < 0) {
      look_at(state.after({-acceleration / jerk, phase.along, phase.across}));
    }
    state = state.after(phase);
    look_at(state);
  }
  return strain;
}

}  // namespace kcs::planning
