#include "server/jobs/plan_store.h"

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

TEST(PlanStore, ForgetsThePlanThatWasNotUsedForLongest) {
  PlanStore store(2, 1 << 20);
  store.keep(plan("a"));
  store.keep(plan("b"));
  EXPECT_NE(store.find("a"), nullptr);
  store.keep(plan("c"));
  EXPECT_NE(store.find("a"), nullptr);
  EXPECT_EQ(store.find("b"), nullptr);
  EXPECT_NE(store.find("c"), nullptr);
}

TEST(PlanStore, MakesRoomInBytes) {
  constexpr std::size_t kPhases = 1000;
  PlanStore store(100, 5 * plan("a", kPhases)->plan.trajectory.bytes() / 2);
  store.keep(plan("a", kPhases));
  store.keep(plan("b", kPhases));
  EXPECT_NE(store.find("a"), nullptr);
  store.keep(plan("c", kPhases));
  EXPECT_NE(store.find("a"), nullptr);
  EXPECT_EQ(store.find("b"), nullptr);
  EXPECT_TRUE(store.forget("a"));
  EXPECT_TRUE(store.forget("c"));
  store.keep(plan("d", 2 * kPhases));
  EXPECT_NE(store.find("d"), nullptr);
  EXPECT_THROW(store.keep(plan("e", 3 * kPhases)), CapExceeded);
  EXPECT_NE(store.find("d"), nullptr);
}

TEST(PlanStore, CountsTheCornersToo) {
  constexpr std::size_t kCorners = 1000;
  auto large = std::make_shared<KeptPlan>();
  large->name = "a";
  for (std::size_t i = 0; i < kCorners; ++i) large->plan.corners.append({.segment = i});
  PlanStore store(100, large->plan.corners.bytes());
  EXPECT_THROW(store.keep(large), CapExceeded);
  EXPECT_EQ(store.find("a"), nullptr);
}

TEST(PlanStore, KeepsAPlanAliveForItsReaders) {
  PlanStore store(1, 1 << 20);
  store.keep(plan("a"));
  const PlanPointer held = store.find("a");
  store.keep(plan("b"));
  EXPECT_EQ(store.find("a"), nullptr);
  EXPECT_EQ(held->name, "a");
  EXPECT_EQ(held.use_count(), 1);
}

TEST(PlanStore, KeepingAPlanTwiceCountsItOnce) {
  PlanStore store(2, 1 << 20);
  store.keep(plan("a"));
  store.keep(plan("b"));
  store.keep(plan("b"));
  EXPECT_NE(store.find("a"), nullptr);
  EXPECT_TRUE(store.forget("b"));
  EXPECT_FALSE(store.forget("b"));
}

}  // namespace
}  // namespace kcs::jobs
