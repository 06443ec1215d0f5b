// What drives would say of the setpoints that they get.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "server/motion/limits.h"

namespace kcs::test {

// Judges setpoints by their differences alone: if a motion is inside its limits, the first, second and third
// differences of its samples are inside those times the first, second and third power of the period.
class Drives {
 public:
  // At rest at `start`, mm.
  Drives(const motion::AxisLimits& limits, double period, const motion::Vector& start)
      : limits_(limits), period_(period) {
    before_.fill(start);
  }

  // Fails the test if it breaks a limit.
  void take(const motion::Vector& position) {
    const auto [one, two, three] = before_;
    const double rounding = 16 * std::numeric_limits<double>::epsilon() * position.cwiseAbs().maxCoeff();
    for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(limits_.axes); ++i) {
      const auto inside = [&](double difference, double limit) {
        return std::abs(difference) <= limit * (1 + 1e-6) + rounding;
      };
      ASSERT_TRUE(inside(position[i] - one[i], limits_.velocity[i] * period_));
      ASSERT_TRUE(inside(position[i] - 2 * one[i] + two[i], limits_.acceleration[i] * std::pow(period_, 2)));
      ASSERT_TRUE(inside(position[i] - 3 * one[i] + 3 * two[i] - three[i], limits_.jerk[i] * std::pow(period_, 3)));
    }
    before_ = {position, one, two};
  }

  // It stands for a while.
  void rest() {
    for (int i = 0; i < 3; ++i) take(before_[0]);
  }

  const motion::Vector& position() const { return before_[0]; }

 private:
  motion::AxisLimits limits_;
  double period_;
  std::array<motion::Vector, 3> before_;  // the latest first
};

}  // namespace kcs::test
