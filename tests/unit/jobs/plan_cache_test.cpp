#include "server/jobs/plan_cache.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "server/jobs/cap_exceeded.h"

namespace kcs::jobs {
namespace {

PlanPointer plan(const std::string& name, std::size_t phases = 0) {
  auto made = std::make_shared<KeptPlan>();
  made->name = name;
  for (std::size_t i = 0; i < phases; ++i) {
    made->plan.trajectory.append({.start_time = static_cast<double>(i), .duration = 1});
  }
  return made;
}

TEST(PlanCache, ForgetsThePlanThatWasNotUsedForLongest) {
  PlanCache cache(2, 1 << 20);
  cache.keep(plan("a"));
  cache.keep(plan("b"));
  EXPECT_NE(cache.find("a"), nullptr);
  cache.keep(plan("c"));
  EXPECT_NE(cache.find("a"), nullptr);
  EXPECT_EQ(cache.find("b"), nullptr);
  EXPECT_NE(cache.find("c"), nullptr);
}

TEST(PlanCache, MakesRoomInBytes) {
  constexpr std::size_t kPhases = 1000;
  PlanCache cache(100, 5 * plan("a", kPhases)->plan.trajectory.bytes() / 2);
  cache.keep(plan("a", kPhases));
  cache.keep(plan("b", kPhases));
  EXPECT_NE(cache.find("a"), nullptr);
  cache.keep(plan("c", kPhases));
  EXPECT_NE(cache.find("a"), nullptr);
  EXPECT_EQ(cache.find("b"), nullptr);
  EXPECT_TRUE(cache.forget("a"));
  EXPECT_TRUE(cache.forget("c"));
  cache.keep(plan("d", 2 * kPhases));
  EXPECT_NE(cache.find("d"), nullptr);
  EXPECT_THROW(cache.keep(plan("e", 3 * kPhases)), CapExceeded);
  EXPECT_NE(cache.find("d"), nullptr);
}

TEST(PlanCache, CountsTheCornersToo) {
  constexpr std::size_t kCorners = 1000;
  auto large = std::make_shared<KeptPlan>();
  large->name = "a";
  for (std::size_t i = 0; i < kCorners; ++i) large->plan.corners.append({.segment = i});
  PlanCache cache(100, large->plan.corners.bytes());
  EXPECT_THROW(cache.keep(large), CapExceeded);
  EXPECT_EQ(cache.find("a"), nullptr);
}

TEST(PlanCache, KeepsAPlanAliveForItsReaders) {
  PlanCache cache(1, 1 << 20);
  cache.keep(plan("a"));
  const PlanPointer held = cache.find("a");
  cache.keep(plan("b"));
  EXPECT_EQ(cache.find("a"), nullptr);
  EXPECT_EQ(held->name, "a");
  EXPECT_EQ(held.use_count(), 1);
}

TEST(PlanCache, KeepingAPlanTwiceCountsItOnce) {
  PlanCache cache(2, 1 << 20);
  cache.keep(plan("a"));
  cache.keep(plan("b"));
  cache.keep(plan("b"));
  EXPECT_NE(cache.find("a"), nullptr);
  EXPECT_TRUE(cache.forget("b"));
  EXPECT_FALSE(cache.forget("b"));
}

}  // namespace
}  // namespace kcs::jobs
