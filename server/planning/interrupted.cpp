#include "server/planning/interrupted.h"

#include <algorithm>
#include <cmath>

namespace kcs::planning {
namespace {

// The speed at which the middle of the corner is `cut` away from its point.
double speed_for_cut(double cut, double turn, double acceleration, double jerk) {
  const double t1 = std::cbrt(6 * cut / (turn * jerk));
  if (jerk * t1 <= acceleration) return jerk * t1 * t1;
  const double square = acceleration * acceleration / jerk;
  return std::sqrt(8 * acceleration * cut / turn - square * square / 3);
}

}  // namespace

Interrupted::Interrupted(const CornerGeometry& corner, const AxisLimits& limits)
    : turn_(2 * corner.half_sine),
      acceleration_(along(limits.acceleration, corner.difference, limits.axes)),
      jerk_(along(limits.jerk, corner.difference, limits.axes)),
      max_speed_(std::min({speed_for_cut(corner.cut, turn_, acceleration_, jerk_), corner.in.feed, corner.out.feed})) {}

Interrupted::Times Interrupted::times(double speed) const {
  if (speed * jerk_ <= acceleration_ * acceleration_) return {std::sqrt(speed / jerk_), 0};
  const double t1 = acceleration_ / jerk_;
  return {t1, speed / acceleration_ - t1};
}

CornerMotion Interrupted::at(double speed) const {
  if (speed == 0) return {};
  const auto [t1, t2] = times(speed);
  return {.speed = speed,
          .acceleration = 0,
          .length = speed * (2 * t1 + t2) / 2,
          .duration = 2 * t1 + t2,
          .cut = speed * turn_ * (t1 * t1 / 6 + t1 * t2 / 4 + t2 * t2 / 8) / (t1 + t2)};
}

void Interrupted::append_phases(const CornerGeometry& corner, double speed, std::vector<motion::Phase>& phases) const {
  const auto [t1, t2] = times(speed);
  const double length = speed * (2 * t1 + t2) / 2;
  const Vector acceleration = corner.difference * (speed / (t1 + t2));
  const Vector jerk = acceleration / t1;
  motion::Phase rise{.duration = t1, .jerk = jerk};
  rise.start.position = corner.in.end - length * corner.in.direction;
  rise.start.velocity = speed * corner.in.direction;
  phases.push_back(rise);
  if (t2 > 0) {
    motion::Phase hold{.duration = t2};
    hold.start = {rise.at(t1).position, rise.at(t1).velocity, acceleration};
    phases.push_back(hold);
  }
  // From the far end, so that it is met exactly.
  motion::Phase fall{.duration = t1, .jerk = -jerk};
  fall.start.position =
      corner.out.start + length * corner.out.direction - speed * t1 * corner.out.direction + jerk * (t1 * t1 * t1 / 6);
  fall.start.velocity = speed * corner.out.direction - jerk * (t1 * t1 / 2);
  fall.start.acceleration = acceleration;
  phases.push_back(fall);
}

}  // namespace kcs::planning
