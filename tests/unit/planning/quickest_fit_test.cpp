// Against motions whose least time is known in closed form.
#include "server/planning/quickest_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stop_token>
#include <vector>

#include "server/planning/stopped.h"

namespace kcs::planning {
namespace {

constexpr std::size_t kPieces = 120;
constexpr double kNoLimit = std::numeric_limits<double>::infinity();

// The three points of either end, as they are with steps so far apart at the end's speed, mm.
void set_ends(std::vector<Vector>& points, double length, double apart) {
  for (std::size_t i = 0; i < 3; ++i) {
    points[i] = (static_cast<double>(i) - 1) * apart * Vector::UnitX();
    points[points.size() - 3 + i] = length * Vector::UnitX() + points[i];
  }
}

// A steady motion along x from rest to rest, or what would be one: all points but the ends are at equal distances.
std::vector<Vector> straight(double length) {
  std::vector<Vector> points;
  for (std::size_t i = 0; i < kPieces + 3; ++i) {
    const double share = (static_cast<double>(i) - 2) / (kPieces - 2);
    points.emplace_back(std::clamp(share, 0.0, 1.0) * length, 0, 0);
  }
  points.back() = points[points.size() - 3] = points[points.size() - 2] = Vector(length, 0, 0);
  return points;
}

struct Limits {
  double speed = kNoLimit, acceleration = kNoLimit, jerk = kNoLimit;
};

// How long it takes if steps are a millisecond long at first, and after so many solutions. It begins and ends at a
// speed, mm/s.
double least_time(std::vector<Vector> points, const Limits& limits, int times = 6, double end_speed = 0) {
  double step = 1e-3;
  const double length = points[points.size() - 2].x() - points[1].x();
  QuickestFit fit;
  for (int i = 0; i < times; ++i) {
    set_ends(points, length, end_speed * step);
    fit.begin(points);
    for (std::size_t j = 0; j + 3 < points.size(); ++j) {
      fit.limit_axes({j, 4, {-1, 3, -3, 1}}, Vector::Constant(limits.jerk * std::pow(step, 3)),
                     QuickestFit::Kind::kJerk);
    }
    for (std::size_t j = 0; j + 2 < points.size(); ++j) {
      fit.limit_axes({j, 3, {1, -2, 1}}, Vector::Constant(limits.acceleration * step * step),
                     QuickestFit::Kind::kAcceleration);
    }
    if (limits.speed < kNoLimit) {
      for (std::size_t j = 0; j + 1 < points.size(); ++j) fit.limit_speed({j, 2, {-1, 1}}, limits.speed * step);
    }
    for (std::size_t j = 0; j < points.size(); ++j) fit.place({j, 1, {1}}, {Vector::Zero(), Vector::UnitX(), 0.01});
    EXPECT_TRUE(fit.solve({})) << i;
    points.assign(fit.points().begin(), fit.points().end());
    step *= fit.longer();
  }
  return step * kPieces;
}

// Full jerk in four phases, the outer ones half as long as the inner ones.
TEST(QuickestFit, FindsTheLeastTimeUnderAJerkLimit) {
  EXPECT_NEAR(least_time(straight(1), {.jerk = 1e5}), std::cbrt(32 * 1 / 1e5), 0.01 * std::cbrt(32 * 1 / 1e5));
}

TEST(QuickestFit, FindsTheLeastTimeUnderAnAccelerationLimit) {
  const double exact = 2 * std::sqrt(1 / 2000.0);
  EXPECT_NEAR(least_time(straight(1), {.acceleration = 2000, .jerk = 1e9}), exact, 0.02 * exact);
}

TEST(QuickestFit, FindsTheLeastTimeUnderASpeedLimit) {
  const double exact = 10 / 100.0 + 100 / 2000.0;
  EXPECT_NEAR(least_time(straight(10), {.speed = 100, .acceleration = 2000, .jerk = 1e9}), exact, 0.02 * exact);
}

// The tool travels so fast at the ends that a step's change by a thousandth moves their points by more than jerk moves
// them in a step.
TEST(QuickestFit, FindsTheLeastTimeBetweenEndsInMotion) {
  const double speed = 80, jerk = 1e5, exact = 0.1;
  const double length = speed * exact + jerk * exact * exact * exact / 32;
  EXPECT_NEAR(least_time(straight(length), {.jerk = jerk}, 3, speed), exact, 0.01 * exact);
}

// Its points begin far from where they must be.
TEST(QuickestFit, ComesFromOutside) {
  auto points = straight(1);
  for (std::size_t i = 3; i + 3 < points.size(); ++i)
    points[i] += Vector(0.3 * std::sin(static_cast<double>(i)), 1, -1);
  EXPECT_NEAR(least_time(points, {.jerk = 1e5}, 8), std::cbrt(32 * 1 / 1e5), 0.01 * std::cbrt(32 * 1 / 1e5));
}

TEST(QuickestFit, LeavesTheEndsWhereTheyAre) {
  const auto points = straight(1);
  QuickestFit fit;
  fit.begin(points);
  for (std::size_t j = 0; j + 3 < points.size(); ++j) {
    fit.limit_axes({j, 4, {-1, 3, -3, 1}}, Vector::Constant(1e-4), QuickestFit::Kind::kJerk);
  }
  for (std::size_t j = 0; j < points.size(); ++j) fit.place({j, 1, {1}}, {Vector::Zero(), Vector::UnitX(), 0.01});
  ASSERT_TRUE(fit.solve({}));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(fit.points()[i], points[i]);
    EXPECT_EQ(fit.points()[points.size() - 1 - i], points[points.size() - 1 - i]);
  }
}

TEST(QuickestFit, SaysThatNothingKeepsItAll) {
  const auto points = straight(1);
  QuickestFit fit;
  fit.begin(points);
  for (std::size_t j = 0; j + 3 < points.size(); ++j) {
    fit.limit_axes({j, 4, {-1, 3, -3, 1}}, Vector::Constant(1e-4), QuickestFit::Kind::kJerk);
  }
  fit.place({50, 1, {1}}, {.origin = {0.4, 0, 0}, .radius = 0.01});
  fit.place({50, 1, {1}}, {.origin = {0.4, 0.1, 0}, .radius = 0.01});
  EXPECT_FALSE(fit.solve({}));
}

TEST(QuickestFit, StopsWhenNobodyWaits) {
  const auto points = straight(1);
  std::stop_source source;
  source.request_stop();
  QuickestFit fit;
  fit.begin(points);
  fit.limit_speed({5, 2, {-1, 1}}, 1);
  EXPECT_THROW(fit.solve(source.get_token()), Stopped);
}

}  // namespace
}  // namespace kcs::planning
