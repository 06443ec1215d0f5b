#include "server/motion/polynomial.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace kcs::motion {
namespace {

std::vector<double> roots(const std::array<double, 4>& coefficients, double end) {
  const Roots found = sign_changes(coefficients, end);
  return {found.begin(), found.end()};
}

TEST(SignChanges, FindsAllRootsOfACubic) {
  const auto found = roots({-6, 11, -6, 1}, 10);  // (t − 1)(t − 2)(t − 3)
  ASSERT_EQ(found.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i], static_cast<double>(i + 1), 1e-14);
}

TEST(SignChanges, LooksOnlyInsideTheInterval) { EXPECT_EQ(roots({-6, 11, -6, 1}, 1.5).size(), 1u); }

TEST(SignChanges, KnowsLowerDegrees) {
  EXPECT_EQ(roots({-1, 2, 0, 0}, 1), std::vector<double>{0.5});
  EXPECT_EQ(roots({1, 0, 0, 0}, 1), std::vector<double>{});
  EXPECT_EQ(roots({-2, 0, 0.5, 0}, 10), std::vector<double>{2});
}

TEST(SignChanges, IgnoresTouching) { EXPECT_TRUE(roots({1, -2, 1, 0}, 2).empty()); }  // (t − 1)²

Phase random_phase(std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(-1, 1);
  const auto vector = [&](double size) {
    return Vector(size * share(random), size * share(random), size * share(random));
  };
  return {
      .duration = 0.1 * (1.1 + share(random)), .start = {vector(10), vector(100), vector(2000)}, .jerk = vector(1e5)};
}

TEST(Extremes, AreNeverLessThanAnySampleAndReached) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 2'000; ++i) {
    const Phase phase = random_phase(random);
    Vector velocity = Vector::Zero(), acceleration = Vector::Zero();
    double speed = 0;
    for (int k = 0; k <= 2'000; ++k) {
      const State state = phase.at(phase.duration * k / 2'000);
      velocity = velocity.cwiseMax(state.velocity.cwiseAbs());
      acceleration = acceleration.cwiseMax(state.acceleration.cwiseAbs());
      speed = std::max(speed, state.velocity.norm());
    }
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_GE(largest_velocity(phase)[axis], velocity[axis] * (1 - 1e-12));
      EXPECT_NEAR(largest_velocity(phase)[axis], velocity[axis], 1e-3);
      EXPECT_NEAR(largest_acceleration(phase)[axis], acceleration[axis], 1e-9);
    }
    EXPECT_GE(largest_speed(phase), speed * (1 - 1e-12));
    EXPECT_NEAR(largest_speed(phase), speed, 1e-3);
  }
}

}  // namespace
}  // namespace kcs::motion
