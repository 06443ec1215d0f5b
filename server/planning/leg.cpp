#include "server/planning/leg.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kcs::planning {

double along(const Vector& limit, const Vector& direction, std::size_t axes) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t axis = 0; axis < axes; ++axis) {
    const double share = std::abs(direction[axis]);
    if (share > 0) smallest = std::min(smallest, limit[axis] / share);
  }
  return smallest;
}

double roughly_along(const Vector& limit, const Vector& direction, std::size_t axes) {
  return std::min(along(limit, direction, axes), limit.head(static_cast<Eigen::Index>(axes)).maxCoeff());
}

}  // namespace kcs::planning
