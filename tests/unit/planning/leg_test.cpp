#include "server/planning/leg.h"

#include <gtest/gtest.h>

#include "tests/unit/planning/paths.h"

namespace kcs::planning {
namespace {

const AxisLimits kLimits{3, Vector(100, 200, 50), Vector(1000, 2000, 500), Vector(1e4, 2e4, 5e3)};

TEST(Along, IsTheWeakestAxisShare) {
  EXPECT_DOUBLE_EQ(along(Vector(100, 200, 50), Vector(0.6, 0.8, 0), 3), 100 / 0.6);
  EXPECT_DOUBLE_EQ(along(Vector(100, 200, 50), Vector(0, -0.8, 0.6), 3), 50 / 0.6);
  EXPECT_EQ(along(Vector(100, 200, 50), Vector(0, 0, 0), 3), INFINITY);
}

TEST(RoughlyAlong, IsNoMoreThanTheStrongestAxisAlone) {
  EXPECT_DOUBLE_EQ(roughly_along(Vector(100, 100, 50), Vector(0.6, 0.8, 0), 3), 100);
  EXPECT_DOUBLE_EQ(roughly_along(Vector(100, 100, 50), Vector(0, -0.6, 0.8), 3), 50 / 0.8);
  EXPECT_DOUBLE_EQ(roughly_along(Vector(100, 100, 500), Vector(0.6, 0.8, 0), 2), 100);
}

TEST(Legs, CapTheFeedByTheAxes) {
  const LegPath legs = legs_of(path_through({{0, 0, 10}}, INFINITY, 0.01), kLimits);
  EXPECT_EQ(legs.legs[0].feed, 50);
  EXPECT_EQ(legs.legs[0].acceleration, 500);
  EXPECT_EQ(legs.legs[0].jerk, 5e3);
}

TEST(Legs, JoinWhatLiesOnALineAndAgrees) {
  Toolpath path = path_through({{1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}, {5, 0, 0}}, 10, 0.01);
  EXPECT_EQ(legs_of(path, kLimits).legs.size(), 1u);
  path.segments[1].feed = 20;
  EXPECT_EQ(legs_of(path, kLimits).legs.size(), 3u);
  path.segments[3].stop = true;
  EXPECT_EQ(legs_of(path, kLimits).legs.size(), 4u);
  path.segments[4].tolerance = 0.02;
  EXPECT_EQ(legs_of(path, kLimits).legs.size(), 4u);
}

TEST(Legs, DoNotJoinAReversal) {
  EXPECT_EQ(legs_of(path_through({{2, 0, 0}, {1, 0, 0}, {3, 0, 0}}, 10, 0.01), kLimits).legs.size(), 3u);
}

TEST(Legs, DoNotJoinASlightBend) {
  EXPECT_EQ(legs_of(path_through({{1, 0, 0}, {2, 1e-12, 0}}, 10, 0.01), kLimits).legs.size(), 2u);
}

TEST(Legs, PassOnWhatSegmentsOfNoLengthSay) {
  Toolpath path = path_through({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {2, 0, 0}}, 10, 0.01);
  path.segments[0].dwell = 1;
  path.segments[2].dwell = 2;
  const LegQueue queue = queue_of(path, kLimits);
  ASSERT_EQ(queue.size(), 2u);
  EXPECT_EQ(queue.initial_dwell(), 1);
  EXPECT_TRUE(queue.joint(0).stop);
  EXPECT_EQ(queue.joint(0).dwell, 2);
  EXPECT_EQ(queue.segments(), 2u);
}

}  // namespace
}  // namespace kcs::planning
