#include "server/planning/corner_sides.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kcs::planning {
namespace {

double left(const Vector& limit, const Vector& wanted, const Vector& other, double used, std::size_t axes) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t axis = 0; axis < axes; ++axis) {
    const double share = std::abs(wanted[axis]);
    if (share > 0) least = std::min(least, (limit[axis] - used * std::abs(other[axis])) / share);
  }
  return least;
}

}  // namespace

double CornerSide::left_across(const Vector& limit, double used, std::size_t axes) const {
  return left(limit, across, away, used, axes);
}

double CornerSide::left_along(const Vector& limit, double used, std::size_t axes) const {
  return left(limit, away, across, used, axes);
}

motion::State CornerSide::state(const HalfState& half) const {
  const auto& [along, beside] = half;
  return {corner + (along.position * away + beside.position * across),
          direction * (along.velocity * away + beside.velocity * across),
          along.acceleration * away + beside.acceleration * across};
}

CornerSides::CornerSides(const CornerGeometry& corner)
    : in{.corner = corner.in.end, .away = -corner.in.direction, .direction = -1},
      out{.corner = corner.out.start, .away = corner.out.direction, .direction = 1} {
  const Vector inward = corner.difference * (corner.half_cosine / (2 * corner.half_sine));
  const Vector onward = corner.sum * (corner.half_sine / (2 * corner.half_cosine));
  in.across = inward + onward;
  out.across = inward - onward;
}

}  // namespace kcs::planning
