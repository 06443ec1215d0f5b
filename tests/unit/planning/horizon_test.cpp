#include "server/planning/horizon.h"

#include <gtest/gtest.h>

#include "tests/unit/planning/paths.h"

namespace kcs::planning {
namespace {

constexpr int kLegs = 5000;

const PlanOptions kOptions = options_for(2000, 1e5, ToleranceKind::kContourError, CornerStrategy::kAuto);

// What is in sight of legs of so many mm, each turned by so many degrees from the one before.
Horizon seen(double length, double degrees, double share = 1, std::size_t at_least = 0) {
  Horizon horizon(kOptions.limits, share, 1, at_least);
  EXPECT_TRUE(horizon.in_sight(queue_of(turning_legs(kLegs, length, degrees), kOptions.limits)));
  return horizon;
}

TEST(Horizon, SettlesLessThanItSees) {
  for (const double length : {0.05, 0.3, 5.0}) {
    const Horizon horizon = seen(length, 3);
    EXPECT_LT(horizon.until() + 1, horizon.legs()) << length;
    EXPECT_LT(horizon.legs(), kLegs) << length;
  }
}

TEST(Horizon, SharpCornersBringItNearer) { EXPECT_LT(3 * seen(0.3, 60).legs(), seen(0.3, 3).legs()); }

// A line of many points is one leg, but all its points wait for it to be settled.
TEST(Horizon, CountsTheSegmentsOfLongLines) {
  constexpr int kLines = 30, kPoints = 4000;
  Toolpath path;
  for (int line = 0; line < kLines; ++line) {
    for (int i = 1; i <= kPoints; ++i) {
      const double along = 0.1 * (line % 2 == 0 ? i : kPoints - i);
      path.segments.push_back({.end = {along, 0.5 * line, 0}, .feed = 100, .tolerance = 0.05});
    }
    path.segments.push_back(
        {.end = {path.segments.back().end.x(), 0.5 * (line + 1), 0}, .feed = 100, .tolerance = 0.05});
  }
  Horizon horizon(kOptions.limits);
  ASSERT_TRUE(horizon.in_sight(queue_of(path, kOptions.limits)));
  EXPECT_LT(horizon.legs(), 2U * kLines * 3 / 4);
}

// Where the tool crawls, the feed says little about how long a motion becomes.
TEST(Horizon, IsNearWhereTheToolIsFarSlowerThanTheFeed) {
  const AxisLimits weak = options_for(20, 1e5, ToleranceKind::kContourError, CornerStrategy::kAuto).limits;
  Horizon horizon(weak);
  ASSERT_TRUE(horizon.in_sight(queue_of(turning_legs(kLegs, 0.3, 5), weak)));
  EXPECT_LT(horizon.legs(), kLegs / 2);
}

TEST(Horizon, SeesNoLessThanItIsTold) {
  const Horizon usual = seen(0.3, 3, 0.5);
  EXPECT_EQ(seen(0.3, 3, 0.5, 2 * usual.legs()).legs(), 2 * usual.legs());
  EXPECT_EQ(seen(0.3, 3, 0.5, 2 * usual.legs()).until(), usual.until());
  EXPECT_EQ(seen(0.3, 3, 0.5, usual.legs() / 2).legs(), usual.legs());
}

TEST(Horizon, WaitsForThePathOrItsEnd) {
  LegQueue queue(Vector::Zero(), kOptions.limits);
  Horizon horizon(kOptions.limits);
  for (const Segment& segment : turning_legs(20, 0.3, 3).segments) {
    queue.add(segment);
    EXPECT_FALSE(horizon.in_sight(queue));
  }
  queue.finish();
  EXPECT_TRUE(horizon.in_sight(queue));
  EXPECT_EQ(horizon.legs(), 20u);
  EXPECT_EQ(horizon.until(), 19u);
}

}  // namespace
}  // namespace kcs::planning
