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

constexpr double kDwell = 0.2345;  // s

// A line, the dwell, and another line.
planning::Plan dwelling() {
  planning::Toolpath path;
  path.segments.push_back({.end = {10, 0, 0}, .feed = kFeed, .tolerance = 0.01, .stop = true});
  path.segments.back().dwell = kDwell;
  path.segments.push_back({.end = {10, 10, 0}, .feed = kFeed, .tolerance = 0.01});
  return planning::plan(path, machine());
}

// Where the plan is after the setpoints that a run at this rate gives until it is beyond the dwell, or has rested
// there.
struct Passage {
  std::size_t dwelling = 0;  // setpoints in the corner
  ClockState end;
};

Passage pass(BatchMaker& maker, ClockState from, double rate) {
  Passage passage{.end = from};
  for (int i = 0; i < 500 && passage.end.plan_time < kDwell + 0.6; ++i) {
    const auto batch = maker.next(passage.end, rate);
    if (!batch) break;
    for (const motion::Vector& position : batch->positions) {
      passage.dwelling += position == motion::Vector(10, 0, 0) ? 1 : 0;
    }
    passage.end = batch->end;
    if (batch->end_of_plan) break;
  }
  return passage;
}

double dwell_begin(const planning::Plan& plan) {
  for (const motion::Phase& phase : plan.trajectory) {
    if (phase.rests()) return phase.start_time;
  }
  return -1;
}

TEST(BatchMaker, DwellsAsLongAsProgrammedAtAnyRate) {
  const planning::Plan plan = dwelling();
  for (const double rate : {0.1, 0.5, 1.0, 1.7, 2.0}) {
    BatchMaker maker(plan, machine().limits, {});
    const Passage passage = pass(maker, {0, 0, 0}, rate);
    // At its ends the motion is slower than what can be told from rest.
    EXPECT_NEAR(0.001 * static_cast<double>(passage.dwelling), kDwell, 0.003) << rate;
    EXPECT_GT(passage.end.plan_time, dwell_begin(plan) + kDwell) << rate;
  }
}

TEST(BatchMaker, WaitsAtTheEndOfADwellAtTheRateZero) {
  const planning::Plan plan = dwelling();
  BatchMaker maker(plan, machine().limits, {});
  const double begin = dwell_begin(plan);
  const Passage passage = pass(maker, {begin + 0.1, 1, 0}, 0);
  EXPECT_EQ(passage.end.plan_time, begin + kDwell);
  EXPECT_TRUE(passage.end.rests());
}

TEST(BatchMaker, AHeldDwellGoesOnWhereItWas) {
  const planning::Plan plan = dwelling();
  const double begin = dwell_begin(plan);
  BatchMaker maker(plan, machine().limits, {});
  const auto batch = maker.next({begin + 0.1, 1, 0}, 0.5);
  ASSERT_TRUE(batch);
  EXPECT_TRUE(batch->tail.empty()) << "it rests";
  EXPECT_NEAR(batch->tail_end, begin + 0.12, 1e-12);
  const auto resumed = BatchMaker(plan, machine().limits, {}).next({batch->tail_end, 0, 0}, 0.5);
  ASSERT_TRUE(resumed);
  EXPECT_NEAR(resumed->end.plan_time, begin + 0.14, 1e-12);
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
