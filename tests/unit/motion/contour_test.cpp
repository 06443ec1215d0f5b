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

std::array<Piece, 2> pieces_through(const Vector& a, const Vector& b, const Vector& c) {
  return {Piece{.from = a, .to = b}, Piece{.from = b, .to = c}};
}

TEST(LargestContourError, MeasuresARoundedCornerFromAbove) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> share(-1, 1);
  for (int i = 0; i < 2'000; ++i) {
    const auto pieces =
        pieces_through({-10, 0, 0}, {0, 0, 0}, {10 * share(random), 10 * share(random), 10 * share(random)});
    Phase phase{.duration = 1, .jerk = Vector(share(random), share(random), share(random))};
    phase.start.position = Vector(-1, 0, 0);
    phase.start.velocity = Vector(1, share(random), share(random));
    double sampled = 0;
    for (int k = 0; k <= 4'000; ++k) {
      const Vector point = phase.at(k / 4'000.0).position;
      sampled = std::max(sampled, std::min(distance_to_segment(point, pieces[0].from, pieces[0].to),
                                           distance_to_segment(point, pieces[1].from, pieces[1].to)));
    }
    const double found = largest_contour_error(phase, pieces, 1e-9, 0);
    EXPECT_GE(found, sampled - 1e-15);
    EXPECT_LE(found, sampled + 1e-3);
    EXPECT_NEAR(found, largest_contour_error(phase, pieces, 1e-7, 0), 1.1e-7);
  }
}

TEST(LargestContourError, IsNothingAcrossTheBordersOfPiecesOnALine) {
  const auto pieces = pieces_through({0, 0, 0}, Vector(1, 1, 1) / 3, {1e4, 1e4, 1e4});
  Phase phase{.duration = 1e4};
  phase.start.velocity = Vector(1, 1, 1);
  EXPECT_LE(largest_contour_error(phase, pieces, 1e-12, 0), 1e-11);
}

TEST(ClosestApproach, FindsTheNearestPlaceOfACurve) {
  Phase phase{.duration = 3};
  phase.start.position = Vector(-1, 2, 0);
  phase.start.velocity = Vector(1, 0, 0);
  EXPECT_NEAR(closest_approach(phase, {0.123, 0, 0}), 2, 1e-9);
  EXPECT_NEAR(closest_approach(phase, {-4, -2, 0}), 5, 1e-9);
  EXPECT_NEAR(closest_approach(phase, {5, 2, 0}), 3, 1e-9);
}

TEST(Course, JoinsWhatIsOnALineAndAgrees) {
  const std::array<Vector, 5> points{Vector(0, 0, 0), Vector(1, 0, 0), Vector(2, 0, 0), Vector(3, 0, 0),
                                     Vector(3, 1, 0)};
  const std::array<double, 4> feed{10, 10, 20, 20}, tolerance{}, reach{}, rest{-1, -1, -1, -1};
  const Course course({points, feed, tolerance, reach, rest});
  ASSERT_EQ(course.pieces().size(), 3u);
  EXPECT_EQ(course.pieces()[0].to, points[2]);
  EXPECT_EQ(course.pieces_of({1, 3}).first, 0u);
  EXPECT_EQ(course.pieces_of({1, 3}).last, 2u);
}

TEST(Course, BreaksWhereTheToolRests) {
  const std::array<Vector, 3> points{Vector(0, 0, 0), Vector(1, 0, 0), Vector(2, 0, 0)};
  const std::array<double, 2> feed{10, 10}, tolerance{}, reach{}, rest{0, -1};
  EXPECT_EQ(Course({points, feed, tolerance, reach, rest}).pieces().size(), 2u);
}

}  // namespace
}  // namespace kcs::motion
