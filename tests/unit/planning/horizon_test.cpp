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
