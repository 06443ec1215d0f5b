// How far AUTO is from the best time that any jerk-limited motion can have. The bounds come from a linear program over
// 200 time steps, for a motion that only cuts the corner (2 % of the tolerance allowed outside); good to about 0.3 %.

#include <gtest/gtest.h>

#include <vector>

#include "server/planning/plan_path.h"
#include "tests/unit/planning/paths.h"

namespace kcs::planning {
namespace {

// Two legs of 10 mm, the first along X, rest to rest, F = 100 mm/s, A = 2500 mm/s², J = 2e5 mm/s³, tolerance as the
// corner distance.
struct Row {
  double angle;      // degrees
  double tolerance;  // mm
  double bound;      // s
};
constexpr Row kRows[] = {{15, 0.01, 0.2723},  {15, 0.05, 0.2523},  {15, 0.1, 0.2520},  {30, 0.01, 0.2831},
                         {30, 0.05, 0.2610},  {30, 0.1, 0.2527},   {60, 0.01, 0.2893}, {60, 0.05, 0.2749},
                         {60, 0.1, 0.2667},   {90, 0.01, 0.2908},  {90, 0.05, 0.2825}, {90, 0.1, 0.2777},
                         {120, 0.01, 0.2877}, {120, 0.05, 0.2832}, {120, 0.1, 0.2801}, {150, 0.01, 0.2874},
                         {150, 0.05, 0.2862}, {150, 0.1, 0.2848}};

constexpr double kStraightOn = 0.2525;  // s, without a corner

double cycle_time(const Toolpath& path, double acceleration, double jerk, ToleranceKind kind) {
  return plan(path, options_for(acceleration, jerk, kind, CornerStrategy::kAuto)).summary.cycle_time;
}

double time_of(const Row& row) {
  return cycle_time(two_legs(row.angle, row.tolerance), 2500, 2e5, ToleranceKind::kCornerDistance);
}

TEST(CornerLimit, EveryCornerTakesAtMostTwoPercentMoreThanTheBound) {
  for (const Row& row : kRows) {
    EXPECT_LE(time_of(row), 1.02 * row.bound) << row.angle << "°, " << row.tolerance << " mm";
  }
}

TEST(CornerLimit, AllCornersTogetherLoseAtMostTenPercentMoreThanTheBound) {
  double lost = 0, least = 0;
  for (const Row& row : kRows) {
    lost += time_of(row) - kStraightOn;
    least += row.bound - kStraightOn;
  }
  EXPECT_LE(lost, 1.10 * least);
}

TEST(CornerLimit, ARightAngleTakesNoLongerThanWithoutJerkLimit) {
  // LinuxCNC without a jerk limit takes 0.310 s and 0.319 s, its newest version 0.278 s and 0.282 s.
  EXPECT_LE(cycle_time(two_legs(90, 0.1), 2500, 2e5, ToleranceKind::kContourError), 0.280);
  EXPECT_LE(cycle_time(two_legs(90, 0.01), 2500, 2e5, ToleranceKind::kContourError), 0.292);
}

TEST(CornerLimit, ARightAngleTakesSevenTenthsOfTheTimeOfAnSCurve) {
  EXPECT_LE(cycle_time(two_legs(90, 0.1), 2500, 5e4, ToleranceKind::kContourError), 0.7 * 0.494);
}

TEST(CornerLimit, AZigZagTakesNoLongerThanWithoutJerkLimit) {
  // tests/data/zigzag.nc
  const Toolpath path =
      path_through({{20, 0, 0}, {3, 10, 0}, {22, 16, 0}, {4, 25, 0}, {23, 30, 0}, {16, 48, 0}, {2, 62, 0}}, 100, 0.05);
  EXPECT_LE(cycle_time(path, 2000, 1e5, ToleranceKind::kContourError), 1.70);
  EXPECT_LE(cycle_time(path, 2000, 5e4, ToleranceKind::kContourError), 0.82 * 2.144);
}

}  // namespace
}  // namespace kcs::planning
