#include "server/motion/contour.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <vector>

#include "server/motion/mitres.h"

namespace kcs::motion {
namespace {

std::vector<Piece> pieces_through(const std::vector<Vector>& points) {
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    pieces.emplace_back(points[i], PathSegment{.end = points[i + 1]}, static_cast<std::uint32_t>(i));
  }
  return pieces;
}

double distance(const Vector& point, std::span<const Piece> pieces) {
  double nearest = INFINITY;
  for (const Piece& piece : pieces) nearest = std::min(nearest, piece.line.square_distance(point));
  return std::sqrt(nearest);
}

double sampled_contour_error(const Phase& phase, std::span<const Piece> pieces) {
  double largest = 0;
  for (int k = 0; k <= 4'000; ++k) {
    largest = std::max(largest, distance(phase.at(phase.duration * k / 4'000).position, pieces));
  }
  return largest;
}

// With the curve divided where it passes from piece to piece.
double largest_contour_error(const Phase& phase, std::span<const Piece> pieces, double resolution) {
  std::vector<double> mitres;
  pass_mitres(phase, pieces, mitres);
  return motion::largest_contour_error(phase, pieces, mitres, resolution, 0);
}

// Numbers between −1 and 1.
class Random {
 public:
  double operator()() { return share_(generator_); }
  Vector vector() { return {(*this)(), (*this)(), (*this)()}; }

 private:
  std::mt19937_64 generator_{5};
  std::uniform_real_distribution<double> share_{-1, 1};
};

TEST(LargestContourError, MeasuresARoundedCornerFromAbove) {
  Random random;
  for (int i = 0; i < 2'000; ++i) {
    const auto pieces = pieces_through({{-10, 0, 0}, {0, 0, 0}, 10 * random.vector()});
    Phase phase{.duration = 1, .jerk = random.vector()};
    phase.start.position = Vector(-1, 0, 0);
    phase.start.velocity = Vector(1, random(), random());
    const double sampled = sampled_contour_error(phase, pieces), found = largest_contour_error(phase, pieces, 1e-9);
    EXPECT_GE(found, sampled - 1e-15);
    EXPECT_LE(found, sampled + 1e-3);
    EXPECT_NEAR(found, largest_contour_error(phase, pieces, 1e-7), 1.1e-7);
  }
}

TEST(LargestContourError, MeasuresAcrossManyPiecesInAnyOrderFromAbove) {
  Random random;
  for (int i = 0; i < 2'000; ++i) {
    std::vector<Vector> points{{0, 0, 0}};
    while (points.size() < 8) points.push_back(points.back() + random.vector());
    const auto pieces = pieces_through(points);
    const Phase phase{
        .duration = 2, .start = {random.vector(), 2 * random.vector(), 2 * random.vector()}, .jerk = random.vector()};
    const double sampled = sampled_contour_error(phase, pieces), found = largest_contour_error(phase, pieces, 1e-9);
    EXPECT_GE(found, sampled - 1e-15);
    EXPECT_LE(found, sampled + 1e-2);
    // Where the curve is divided changes nothing.
    EXPECT_NEAR(found, motion::largest_contour_error(phase, pieces, std::vector<double>(pieces.size() - 1, 0), 1e-9, 0),
                1e-9);
  }
}

TEST(LargestContourError, IsNothingAcrossTheBordersOfPiecesOnALine) {
  const auto pieces = pieces_through({{0, 0, 0}, Vector(1, 1, 1) / 3, {1e4, 1e4, 1e4}});
  Phase phase{.duration = 1e4};
  phase.start.velocity = Vector(1, 1, 1);
  EXPECT_LE(largest_contour_error(phase, pieces, 1e-12), 1e-11);
}

TEST(ComesWithin, KnowsTheNearestPlaceOfALine) {
  Phase phase{.duration = 3};
  phase.start.position = Vector(-1, 2, 0);
  phase.start.velocity = Vector(1, 0, 0);
  const Curve curve = Curve::between(phase.start, phase.at(3), 3);
  const auto nearest_is = [&](const Vector& point, double distance) {
    EXPECT_TRUE(comes_within(curve, point, distance * (1 + 1e-9)));
    EXPECT_FALSE(comes_within(curve, point, distance * (1 - 1e-9)));
  };
  nearest_is({0.123, 0, 0}, 2);
  nearest_is({-4, -2, 0}, 5);
  nearest_is({5, 2, 0}, 3);
}

TEST(ComesWithin, KnowsTheNearestPlaceOfACurve) {
  Random random;
  for (int i = 0; i < 2'000; ++i) {
    const Phase phase{
        .duration = 2, .start = {random.vector(), 2 * random.vector(), 2 * random.vector()}, .jerk = random.vector()};
    const Curve curve = Curve::between(phase.start, phase.at(2), 2);
    const Vector point = random.vector();
    double sampled = INFINITY;
    for (int k = 0; k <= 4'000; ++k) sampled = std::min(sampled, (phase.at(k / 2'000.0).position - point).norm());
    EXPECT_TRUE(comes_within(curve, point, sampled * (1 + 1e-9)));
    EXPECT_FALSE(comes_within(curve, point, sampled - 1e-2));
  }
}

TEST(Mitres, ArePassedInTheMiddleOfASymmetricCorner) {
  const auto pieces = pieces_through({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {2, 1, 0}});
  Phase phase{.duration = 1, .jerk = Vector::Zero()};
  phase.start = {Vector(0.5, 0, 0), Vector(1, 0, 0), Vector(-1, 1, 0)};
  std::vector<double> times;
  pass_mitres(phase, pieces, times);
  ASSERT_EQ(times.size(), 2u);
  EXPECT_NEAR((phase.at(times[0]).position - Vector(1, 0, 0)).dot(Vector(1, 1, 0)), 0, 1e-15);
  EXPECT_EQ(times[1], 1);
  pass_mitres(phase, std::span(pieces).last(2), times);
  EXPECT_EQ(times, std::vector<double>{1});
}

}  // namespace
}  // namespace kcs::motion
