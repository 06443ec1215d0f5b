#include "server/planning/sharp_turns.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/unit/planning/paths.h"

namespace kcs::planning {
namespace {

// How many sharp turns a path through these points has, which begins at zero; tolerance 0.01 mm.
int sharp_turns(std::initializer_list<Vector> points) {
  const PlanOptions options = options_for(2000, 1e5, ToleranceKind::kContourError, CornerStrategy::kAuto);
  SharpTurns turns;
  int count = 0;
  for (const Leg& leg : legs_of(path_through(points, 100, 0.01), options.limits).legs) count += turns.before(leg);
  return count;
}

TEST(SharpTurns, AreCountedByTheirAngle) {
  EXPECT_EQ(sharp_turns({{1, 0, 0}, {2, 0.1, 0}, {3, 0, 0}}), 0);  // 6° and 11°
  EXPECT_EQ(sharp_turns({{1, 0, 0}, {2, 0.4, 0}, {3, 0, 0}}), 2);  // 22° and 44°
  EXPECT_EQ(sharp_turns({{1, 0, 0}, {0, 0, 0}}), 1);
}

TEST(SharpTurns, AJogWithinTheToleranceIsNone) {
  EXPECT_EQ(sharp_turns({{1, 0, 0}, {1, 0.0003, 0}, {2, 0.0003, 0}}), 0);
  EXPECT_EQ(sharp_turns({{1, 0, 0}, {1, 0.03, 0}, {2, 0.03, 0}}), 2);
}

TEST(SharpTurns, ACornerOfShortLegsIsOne) {
  EXPECT_EQ(sharp_turns({{1, 0, 0}, {1.004, 0.002, 0}, {1.006, 0.006, 0}, {1.006, 1, 0}}), 1);
}

TEST(SharpTurns, ShortLegsThereAndBackAreLookedAtWithWhatFollows) {
  EXPECT_EQ(sharp_turns({{1, 0, 0}, {1.004, 0, 0}, {1, 0, 0}, {1.004, 0, 0}, {2, 0, 0}}), 0);
}

}  // namespace
}  // namespace kcs::planning
