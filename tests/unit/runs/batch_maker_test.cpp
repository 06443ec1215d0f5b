#include "server/runs/batch_maker.h"

#include <gtest/gtest.h>

#include "server/planning/plan_path.h"

namespace kcs::runs {
namespace {

constexpr double kFeed = 100, kAcceleration = 2000, kJerk = 1e5;

planning::PlanOptions machine() {
  return {.limits = {.axes = 2,
                     .velocity = motion::Vector::Constant(500),
                     .acceleration = motion::Vector::Constant(kAcceleration),
                     .jerk = motion::Vector::Constant(kJerk)}};
}

planning::Plan line(double length) {
  planning::Toolpath path;
  path.segments.push_back({.end = {length, 0, 0}, .feed = kFeed, .tolerance = 0.01});
  return planning::plan(path, machine());
}

TEST(BatchMaker, AtThePlannedPaceGivesThePlansOwnSetpoints) {
  const planning::Plan plan = line(100);
  BatchMaker maker(plan, machine().limits, {});
  const auto batch = maker.next({0.2, 1, 0}, 1);
  ASSERT_TRUE(batch);
  ASSERT_EQ(batch->positions.size(), 20);
  auto phase = plan.trajectory.begin();
  for (int i = 0; i < 20; ++i) {
    const double time = 0.2 + 0.001 * (i + 1);
    phase.seek(time);
    EXPECT_NEAR(batch->positions[static_cast<std::size_t>(i)].x(), phase->at(time - phase->start_time).position.x(),
                1e-9);
  }
  EXPECT_NEAR(batch->end.plan_time, 0.22, 1e-12);
  EXPECT_EQ(batch->end.rate, 1);
}

// The shortest stop from the feed under the limits takes feed / acceleration + acceleration / jerk.
TEST(BatchMaker, StopsNearlyAsFastAsTheLimitsAllow) {
  const planning::Plan plan = line(100);
  BatchMaker maker(plan, machine().limits, {});
  const auto batch = maker.next({0.3, 1, 0}, 1);
  ASSERT_TRUE(batch);
  constexpr double kShortest = kFeed / kAcceleration + kAcceleration / kJerk;
  const double taken = 0.001 * static_cast<double>(batch->tail.size());
  EXPECT_GE(taken, kShortest - 0.001);
  EXPECT_LE(taken, 1.1 * kShortest);
  EXPECT_LT(batch->tail_end, plan.trajectory.duration());
}

TEST(BatchMaker, EndsOnTheExactEnd) {
  const planning::Plan plan = line(10);
  BatchMaker maker(plan, machine().limits, {});
  ClockState state{0, 0, 0};
  std::optional<Batch> batch;
  for (int i = 0; i < 1000 && !(batch && batch->end_of_plan); ++i) {
    batch = maker.next(state, 1);
    ASSERT_TRUE(batch);
    state = batch->end;
  }
  EXPECT_EQ(batch->positions.back(), motion::Vector(10, 0, 0));
  EXPECT_TRUE(batch->tail.empty());
  EXPECT_TRUE(state.rests());
}

TEST(BatchMaker, DependsOnTheStateAlone) {
  const planning::Plan plan = line(100);
  BatchMaker one(plan, machine().limits, {});
  ClockState state{0, 0, 0};
  for (int i = 0; i < 20; ++i) {
    const auto batch = one.next(state, 0.7);
    BatchMaker other(plan, machine().limits, {});
    const auto again = other.next(state, 0.7);
    ASSERT_TRUE(batch && again);
    EXPECT_EQ(batch->positions, again->positions);
    EXPECT_EQ(batch->tail, again->tail);
    state = batch->end;
  }
}

TEST(BatchMaker, MayGoFasterThanPlannedWhereTheLimitsAllowIt) {
  const planning::Plan plan = line(200);
  BatchMaker maker(plan, machine().limits, {});
  ClockState state{0, 0, 0};
  double fastest = 0;
  for (int i = 0; i < 40; ++i) {
    const auto batch = maker.next(state, 2);
    ASSERT_TRUE(batch);
    state = batch->end;
    fastest = std::max(fastest, state.rate);
  }
  EXPECT_NEAR(fastest, 2, 1e-9);
}

TEST(BatchMaker, GivesNoBatchThatCannotBeStoppedWithinTheTailsRoom) {
  const planning::Plan plan = line(100);
  BatchMaker maker(plan, machine().limits, {.tail_capacity = 30});
  EXPECT_FALSE(maker.next({0.3, 1, 0}, 1));
}

}  // namespace
}  // namespace kcs::runs
