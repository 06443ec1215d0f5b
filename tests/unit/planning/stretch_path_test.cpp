#include "server/planning/stretch_path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/planning/paths.h"

namespace kcs::planning {
namespace {

constexpr double kTolerance = 0.1;

using Legs = std::pair<std::size_t, std::size_t>;

// A path, and all of it (or but for its ends) as a stretch.
struct Case {
  explicit Case(const Toolpath& path, double skipped = 0, double left = 0)
      : legs(legs_of(path, options.limits)), stretch(legs, {0, legs.legs.size() - 1, skipped, left}, options) {}

  PlanOptions options = options_for(2000, 1e5, ToleranceKind::kContourError, CornerStrategy::kAuto);
  LegPath legs;
  StretchPath stretch;
};

// Legs of 1 mm, along X and Y in turns.
Toolpath staircase(int legs) {
  Toolpath path;
  for (int i = 1; i <= legs; ++i) {
    path.segments.push_back({.end = Vector((i + 1) / 2, i / 2, 0), .feed = 100, .tolerance = kTolerance});
  }
  return path;
}

TEST(StretchPath, MeasuresTheWayFromWhereItBegins) {
  const Case c(staircase(5), 0.25, 0.5);
  const StretchPath& path = c.stretch;
  EXPECT_DOUBLE_EQ(path.length(), 4.25);
  EXPECT_EQ(path.way(0), 0);
  EXPECT_DOUBLE_EQ(path.way(1), 0.75);
  EXPECT_DOUBLE_EQ(path.way(4), 3.75);
  EXPECT_EQ(path.origin(), Vector::Zero());
  EXPECT_EQ(path.corners().front(), Vector(0.25, 0, 0));
  EXPECT_EQ(path.corners()[1], Vector(1, 0, 0));
  EXPECT_EQ(path.corners().back(), Vector(2.5, 2, 0));
  EXPECT_LT((path.at(2, 2.0) - Vector(1.25, 1, 0)).norm(), 1e-15);
}

TEST(StretchPath, GoesOnStraightBeyondItsEnds) {
  const Case c(staircase(2));
  EXPECT_LT((c.stretch.at(0, -0.5) - Vector(-0.5, 0, 0)).norm(), 1e-15);
  EXPECT_LT((c.stretch.at(1, 2.5) - Vector(1, 1.5, 0)).norm(), 1e-15);
}

TEST(StretchPath, FindsTheLegFromAnyLegNear) {
  const Case c(staircase(6));
  for (std::size_t near = 0; near < 6; ++near) {
    EXPECT_EQ(c.stretch.leg_at(-1, near), 0u);
    EXPECT_EQ(c.stretch.leg_at(0.5, near), 0u);
    EXPECT_EQ(c.stretch.leg_at(3.5, near), 3u);
    EXPECT_EQ(c.stretch.leg_at(9, near), 5u);
  }
}

TEST(StretchPath, KeepsTheLeastTolerance) {
  Toolpath path = staircase(5);
  path.segments[3].tolerance = 0.02;
  EXPECT_EQ(Case(path).stretch.tolerance(), 0.02);
}

TEST(StretchPath, ProjectsToTheNearestPlace) {
  const Case c(staircase(6));
  for (std::size_t near = 0; near < 6; ++near) {
    const Projection inside = c.stretch.project({1.6, 0.95, 0}, near);
    EXPECT_EQ(inside.leg, 2u) << near;
    EXPECT_NEAR(inside.way, 2.6, 1e-14);
    EXPECT_NEAR(inside.distance, 0.05, 1e-14);
  }
  EXPECT_NEAR(c.stretch.project({1.05, -0.05, 0}, 0).distance, std::sqrt(0.005), 1e-14);
  EXPECT_EQ(c.stretch.project({-1, 0, 0}, 0).way, 0);
  EXPECT_EQ(c.stretch.project({3, 4, 0}, 5).way, 6);
}

// 10 mm along X, back over `detour`, and on along X.
Toolpath with_detour(double detour) {
  return path_through({{10, 0, 0}, {10 - detour, detour / 2, 0}, {10 - detour, -detour / 2, 0}, {20, 0, 0}}, 100,
                      kTolerance);
}

TEST(StretchPath, ProjectsPastSmallDetours) {
  const Case small(with_detour(0.1));
  EXPECT_EQ(small.stretch.project({15, 0.01, 0}, 0).leg, 3u);
  EXPECT_EQ(small.stretch.project({5, -0.01, 0}, 3).leg, 0u);
}

TEST(StretchPath, DoesNotProjectToAnotherPartOfThePath) {
  const Case large(with_detour(2));
  EXPECT_NEAR(large.stretch.project({15, 0.01, 0}, 0).way, 10, 1e-12);
}

TEST(StretchPath, KnowsTheLegsAroundAWay) {
  const Case c(staircase(6));  // six tolerances: 0.6 mm
  EXPECT_EQ(c.stretch.legs_between(2.7, 2.8), Legs(2, 3));
  EXPECT_EQ(c.stretch.legs_between(2.5, 2.8), Legs(1, 3));
  EXPECT_EQ(c.stretch.legs_between(2.5, 3.5), Legs(1, 4));
  EXPECT_EQ(c.stretch.legs_between(-3, -2), Legs(0, 0));
  EXPECT_EQ(c.stretch.legs_between(8, 9), Legs(5, 5));
  for (const std::size_t near : {1u, 3u, 5u}) EXPECT_EQ(c.stretch.legs_between(2.5, 2.8, near), Legs(1, 3)) << near;
}

TEST(StretchPath, TakesTheLeastFeedAround) {
  Toolpath path = staircase(6);
  for (std::size_t i = 0; i < 6; ++i) path.segments[i].feed = 10.0 * static_cast<double>(i + 1);
  path.segments[4].feed = 5;
  const Case c(path);
  EXPECT_EQ(c.stretch.feed_between(2.7, 2.8), 30);
  EXPECT_EQ(c.stretch.feed_between(2.5, 2.8), 20);
  EXPECT_EQ(c.stretch.feed_between(2.7, 3.5), 5);
  EXPECT_EQ(c.stretch.feed_between(5.5, 7), 5);
  EXPECT_EQ(c.stretch.feed_between(6.7, 7), 60);
  EXPECT_EQ(Case(staircase(6)).stretch.feed_between(-1, 7), 100);
}

TEST(StretchPath, ReachesCornersByTheMeaningOfTheTolerance) {
  Case c(staircase(3));
  EXPECT_NEAR(c.stretch.reach(0), kTolerance * std::sqrt(2.0), 1e-6);
  c.options.tolerance_kind = ToleranceKind::kCornerDistance;
  EXPECT_NEAR(StretchPath(c.legs, {0, 2, 0, 0}, c.options).reach(0), kTolerance, 1e-6);
}

}  // namespace
}  // namespace kcs::planning
