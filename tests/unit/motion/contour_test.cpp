#include "server/motion/contour.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace kcs::motion {
namespace {

TEST(DistanceToSegment, IsToTheNearestPointOfTheSegment) {
  const Vector from(0, 0, 0), to(10, 0, 0);
  EXPECT_DOUBLE_EQ(distance_to_segment({5, 3, 0}, from, to), 3);
  EXPECT_DOUBLE_EQ(distance_to_segment({-3, 4, 0}, from, to), 5);
  EXPECT_DOUBLE_EQ(distance_to_segment({13, 0, 4}, from, to), 5);
  EXPECT_DOUBLE_EQ(distance_to_segment({1, 1, 0}, from, from), std::sqrt(2));
}

TEST(ContourGauge, MeasuresARoundedCornerFromAbove) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> share(-1, 1);
  for (int i = 0; i < 2'000; ++i) {
    const std::array<Vector, 3> points{Vector(-10, 0, 0), Vector(0, 0, 0),
                                       Vector(10 * share(random), 10 * share(random), 10 * share(random))};
    Phase phase{.duration = 1, .jerk = Vector(share(random), share(random), share(random)), .segments = {0, 1}};
    phase.start.position = Vector(-1, 0, 0);
    phase.start.velocity = Vector(1, share(random), share(random));
    double sampled = 0;
    for (int k = 0; k <= 4'000; ++k) {
      const Vector point = phase.at(k / 4'000.0).position;
      sampled = std::max(sampled, std::min(distance_to_segment(point, points[0], points[1]),
                                           distance_to_segment(point, points[1], points[2])));
    }
    const double found = ContourGauge(points).largest_error(phase, 1e-9, 0);
    EXPECT_GE(found, sampled - 1e-15);
    EXPECT_LE(found, sampled + 1e-3);
    EXPECT_NEAR(found, ContourGauge(points).largest_error(phase, 1e-7, 0), 1.1e-7);
  }
}

TEST(ContourGauge, SeesNoErrorAlongSegmentsOnOneLine) {
  const std::array<Vector, 4> points{Vector(0, 0, 0), Vector(1, 1, 1) / 3, Vector(2, 2, 2) / 3, Vector(1e4, 1e4, 1e4)};
  Phase phase{.duration = 1e4, .segments = {0, 2}};
  phase.start.velocity = Vector(1, 1, 1);
  EXPECT_LE(ContourGauge(points).largest_error(phase, 1e-12, 0), 1e-11);
}

TEST(ContourGauge, LooksOnlyAtThePhasesOwnSegments) {
  const std::array<Vector, 3> points{Vector(0, 0, 0), Vector(10, 0, 0), Vector(10, 1, 0)};
  Phase phase{.duration = 1, .segments = {0, 0}};
  phase.start.position = Vector(10, 1, 0);
  EXPECT_DOUBLE_EQ(ContourGauge(points).largest_error(phase, 1e-12, 0), 1);
}

}  // namespace
}  // namespace kcs::motion
