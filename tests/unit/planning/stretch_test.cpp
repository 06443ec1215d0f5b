// One smooth motion, and what less effort costs.
#include "server/planning/stretch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/unit/planning/paths.h"

namespace kcs::planning {
namespace {

// The whole of a path, from rest to rest.
Stretch stretch_of(const LegPath& legs, Effort effort) {
  PlanOptions options = options_for(2000, 1e5, ToleranceKind::kContourError, CornerStrategy::kAuto);
  options.limits.axes = 3;
  options.effort = effort;
  return {legs, {0, legs.legs.size() - 1, 0, 0}, options, {}};
}

LegPath legs_of(const Toolpath& path) {
  return legs_of(path, {3, Vector::Constant(1000), Vector::Constant(2000), Vector::Constant(1e5)});
}

// 60 mm of waves in legs of 0.2 mm.
LegPath waves() {
  Toolpath path;
  for (int i = 1; i <= 300; ++i) {
    const double x = 0.2 * i;
    path.segments.push_back({.end = {x, 3 * std::sin(x / 4), 0}, .feed = 100, .tolerance = 0.01});
  }
  return legs_of(path);
}

// The tool is lifted, moved to where the next cut begins, and lowered.
LegPath link() { return legs_of(path_through({{0, 0, 2}, {5, 4, 2}, {5, 4, -1}}, 100, 0.01)); }

TEST(Stretch, IsNearlyAsFastWithLessEffort) {
  const LegPath path = waves();
  const Stretch full = stretch_of(path, Effort::kFull), usual = stretch_of(path, Effort::kUsual),
                least = stretch_of(path, Effort::kLeast);
  ASSERT_FALSE(full.failed());
  ASSERT_FALSE(usual.failed());
  ASSERT_FALSE(least.failed());
  EXPECT_LT(usual.duration(), 1.01 * full.duration());
  EXPECT_LT(least.duration(), 1.02 * full.duration());
}

TEST(Stretch, TakesFewCornersOfManyPartsWithLongerSteps) {
  const LegPath path = link();
  const Stretch full = stretch_of(path, Effort::kFull), usual = stretch_of(path, Effort::kUsual);
  ASSERT_FALSE(full.failed());
  ASSERT_FALSE(usual.failed());
  EXPECT_LT(usual.pieces().size(), 0.7 * static_cast<double>(full.pieces().size()));
  EXPECT_LT(usual.duration(), 1.03 * full.duration());
}

// Its neighbours ask for less and less.
TEST(Stretch, MostlyHardlyBecomesSlowerByLowerSpeedsAtItsEnds) {
  const PlanOptions options = options_for(2000, 1e5, ToleranceKind::kContourError, CornerStrategy::kAuto);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> turn(-1.6, 1.6), length(0.5, 4);
  int found = 0, much_slower = 0;
  for (int i = 0; i < 200; ++i) {
    Toolpath path;
    double angle = 0;
    Vector end = Vector::Zero();
    for (int leg = 0; leg < 4; ++leg) {
      const double way = leg == 0 || leg == 3 ? 6 : length(random);
      end += way * Vector(std::cos(angle), std::sin(angle), 0);
      path.segments.push_back({.end = end, .feed = 100, .tolerance = 0.02});
      angle += turn(random);
    }
    const LegPath legs = legs_of(path, options.limits);
    Stretch stretch(legs, {0, legs.legs.size() - 1, 4, 4}, options, {100, 100});
    if (stretch.failed()) continue;
    const double before = stretch.duration();
    for (int times = 0; times < 2 && !stretch.failed(); ++times) {
      stretch.plan({0.97 * stretch.speeds().entry, 0.97 * stretch.speeds().exit});
    }
    if (stretch.failed()) continue;
    ++found;
    if (stretch.duration() > 1.1 * before) ++much_slower;
  }
  EXPECT_GT(found, 150);
  EXPECT_LT(much_slower, 0.25 * found);  // 0.41 if the ends always get exactly the speeds that were asked for
}

}  // namespace
}  // namespace kcs::planning
