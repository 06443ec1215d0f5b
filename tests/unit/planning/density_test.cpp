#include "server/planning/density.h"

#include <gtest/gtest.h>

#include "tests/unit/planning/paths.h"

namespace kcs::planning {
namespace {

// Legs of 1 mm, each turned by so many degrees from the one before, as one stretch.
struct Case {
  explicit Case(double degrees) : legs(legs_of(turning_legs(kLegs, 1, degrees), options.limits)) {}

  bool crowded(std::size_t points) const { return is_crowded(stretch, 0, kLegs, points); }
  bool dense(std::size_t points) const { return is_dense(stretch, 0, kLegs, points); }
  bool sparse(std::size_t points) const { return is_sparse(stretch, 0, kLegs, points); }

  static constexpr std::size_t kLegs = 50;
  PlanOptions options = options_for(2000, 1e5, ToleranceKind::kContourError, CornerStrategy::kAuto);
  LegPath legs;
  StretchPath stretch{legs, {0, kLegs - 1, 0, 0}, options};
};

TEST(Density, SmoothLegsOfFewPointsAreDense) {
  const Case smooth(2);
  EXPECT_TRUE(smooth.dense(5 * Case::kLegs));
  EXPECT_FALSE(smooth.dense(20 * Case::kLegs));
  EXPECT_FALSE(smooth.dense(2 * Case::kLegs));  // few in all
  EXPECT_FALSE(smooth.crowded(5 * Case::kLegs));
}

TEST(Density, SharpCornersOfFewPointsAreCrowdedAndNotDense) {
  const Case sharp(60);
  EXPECT_TRUE(sharp.crowded(5 * Case::kLegs));
  EXPECT_FALSE(sharp.dense(5 * Case::kLegs));
  EXPECT_FALSE(sharp.crowded(20 * Case::kLegs));
}

TEST(Density, LegsOfManyPointsAreSparse) {
  const Case sharp(60);
  EXPECT_TRUE(sharp.sparse(70 * Case::kLegs));
  EXPECT_FALSE(sharp.sparse(50 * Case::kLegs));
  EXPECT_FALSE(is_sparse(sharp.stretch, 0, 0.5, 100));  // few in all
}

TEST(Density, CountsBetweenTheWaysOnly) {
  const Case sharp(60);
  EXPECT_TRUE(is_crowded(sharp.stretch, 0, 50, 500));
  EXPECT_FALSE(is_crowded(sharp.stretch, 0, 25, 500));
  EXPECT_FALSE(is_dense(Case(2).stretch, 0, 25, 500));
  EXPECT_TRUE(is_sparse(sharp.stretch, 0, 4.5, 500));
  EXPECT_FALSE(is_sparse(sharp.stretch, 0, 25, 500));
}

}  // namespace
}  // namespace kcs::planning
