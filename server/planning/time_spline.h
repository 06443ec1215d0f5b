// A motion as a uniform cubic B-spline of time: its pieces are phases of constant jerk.
#pragma once

#include <cstddef>
#include <vector>

#include "server/motion/phase.h"

namespace kcs::planning {

using motion::Vector;

// Control points at equal steps of time. Piece j belongs to the points j to j + 3 and lies inside their hull. Its
// velocity lies inside the hull of the three first differences, its acceleration changes straight from the second
// difference j to j + 1, and its jerk is the third difference: the differences are the motion's exact extremes.
// Three equal points at an end make the motion rest there; three at equal distances on a line make it begin or end
// at the middle one at a steady speed.
struct TimeSpline {
  double step = 0;             // s
  std::vector<Vector> points;  // mm
  std::vector<double> ways;    // where on the path each point belongs, mm; never falling

  std::size_t pieces() const { return points.size() - 3; }
  double duration() const { return step * static_cast<double>(pieces()); }

  Vector velocity(std::size_t j) const { return (points[j + 1] - points[j]) / step; }
  Vector acceleration(std::size_t j) const {
    return ((points[j + 2] - points[j + 1]) - (points[j + 1] - points[j])) / (step * step);
  }
  Vector jerk(std::size_t j) const { return (acceleration(j + 1) - acceleration(j)) / step; }

  // Where piece j begins.
  Vector knot(std::size_t j) const { return (points[j] + 4 * points[j + 1] + points[j + 2]) / 6; }

  // Piece j, without segments. `origin` is added to its position.
  motion::Phase phase(std::size_t j, const Vector& origin) const {
    return {.start_time = step * static_cast<double>(j),
            .duration = step,
            .start = {origin + knot(j), (velocity(j) + velocity(j + 1)) / 2, acceleration(j)},
            .jerk = jerk(j)};
  }
};

}  // namespace kcs::planning
