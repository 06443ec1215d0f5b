#include "tests/unit/gateway/machine/command_judge.h"

#include <fmt/format.h>

#include <cmath>

#include "tests/unit/gateway/machine/straight_motion.h"

namespace kcs::gateway {
namespace {

constexpr double kRounding = 1e-11;  // mm, also of what was written with 15 digits
constexpr double kMargin = 1 + 1e-6;

std::string find_broken_limit(const std::vector<Vector>& commands, const kcs_player_profile& profile, std::size_t i) {
  const double h = profile.period_s;
  const Vector first = commands[i] - commands[i - 1];
  const Vector second = first - (commands[i - 1] - commands[i - 2]);
  const Vector third = second - ((commands[i - 1] - commands[i - 2]) - (commands[i - 2] - commands[i - 3]));
  for (Eigen::Index axis = 0; axis < static_cast<Eigen::Index>(profile.axes); ++axis) {
    const auto breaks = [&](const Vector& difference, double limit) {
      return std::abs(difference[axis]) > limit * kMargin + kRounding;
    };
    if (breaks(first, profile.velocity_mm_s[axis] * h)) return fmt::format("velocity, axis {}, row {}", axis, i);
    if (breaks(second, profile.acceleration_mm_s2[axis] * h * h))
      return fmt::format("acceleration, axis {}, row {}", axis, i);
    if (breaks(third, profile.jerk_mm_s3[axis] * h * h * h)) return fmt::format("jerk, axis {}, row {}", axis, i);
  }
  return "";
}

}  // namespace

std::string find_violation(const std::vector<Vector>& commands, const kcs_player_profile& profile, double length_mm) {
  if (commands.size() < 4) return "too few commands";
  if (commands.front() != StraightMotion::point(0)) return "does not begin at the start";
  if ((commands.back() - StraightMotion::point(length_mm)).norm() > kRounding) return "does not end at the end";
  double way = 0;
  for (std::size_t i = 3; i < commands.size(); ++i) {
    if (auto broken = find_broken_limit(commands, profile, i); !broken.empty()) return broken;
    const double now = commands[i].norm();
    if ((commands[i] - StraightMotion::point(now)).norm() > kRounding) return fmt::format("off the path, row {}", i);
    if (now < way - kRounding) return fmt::format("goes back, row {}", i);
    way = now;
  }
  return "";
}

}  // namespace kcs::gateway
