// Runs of random plans at random paces, stopped and resumed at random: what the drives would see.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "server/planning/plan_path.h"
#include "server/runs/batch_maker.h"
#include "server/runs/paced_motion.h"
#include "tests/motion/drives.h"
#include "tests/property/dense_case.h"
#include "tests/property/long_case.h"
#include "tests/property/random_case.h"

namespace kcs::test {
namespace {

using motion::Vector;
using runs::Batch;
using runs::ClockState;

class Run {
 public:
  Run(const Case& problem, std::uint64_t seed)
      : random_(seed),
        plan_(planning::plan(with_dwells(with_markers(problem.path)), problem.options)),
        period_(std::pow(10, uniform(-4, -2))),
        window_(plan_.trajectory),
        state_{.plan_time = chance(0.3) ? 0 : uniform(0, plan_.trajectory.duration())},
        drives_(problem.options.limits, period_, runs::position(window_, state_.plan_time)),
        batches_(plan_, problem.options.limits,
                 {.period = period_, .setpoints = static_cast<std::size_t>(uniform(1, 40)), .tail_capacity = 100'000}) {
    for (const planning::MarkerAt& it : plan_.markers) next_marker_ += it.time < state_.plan_time ? 1 : 0;
  }

  void go() {
    for (int i = 0; i < 60 && !ended_; ++i) {
      if (chance(0.15)) rate_ = chance(0.5) ? uniform(0, 1) : uniform(1, 2);
      if (chance(0.1)) rate_ = chance(0.5) ? 1 : 0;
      play_batch(chance(0.1));
      if (testing::Test::HasFatalFailure()) return;
    }
  }

  std::uint64_t tails = 0, markers = 0, dwells = 0;

 private:
  struct Dwell {
    double begin;  // s, in the plan
    std::uint64_t tick;
  };

  double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  bool chance(double share) { return uniform(0, 1) < share; }

  void play_batch(bool stop) {
    const auto batch = batches_.next(state_, rate_);
    ASSERT_TRUE(batch) << "no way on from " << state_.plan_time << " s at " << state_.rate;
    for (const Vector& position : batch->positions) drives_.take(position);
    ASSERT_GE(batch->end.plan_time, state_.plan_time);
    ASSERT_GE(batch->tail_end, batch->end.plan_time);
    waited_ = dwell_ && (waited_ || rate_ == 0);
    take_markers(*batch, stop);
    tick_ += batch->positions.size();
    expect_at(batch->end.plan_time);
    state_ = batch->end;
    ended_ = batch->end_of_plan;
    Drives stopping = drives_;
    for (const Vector& position : batch->tail) stopping.take(position);
    stopping.rest();
    ++tails;
    if (!stop || ended_) return;
    drives_ = stopping;
    tick_ += batch->tail.size();
    state_ = {batch->tail_end, 0, 0};
    expect_at(state_.plan_time);
  }

  planning::Toolpath with_markers(planning::Toolpath path) {
    for (float speed = 1; speed <= 5; ++speed) {
      auto& segment = path.segments[random_() % path.segments.size()];
      segment.marker = {.speed = speed, .kind = planning::MarkerKind::kSpindleClockwise};
      segment.stop = segment.stop || chance(0.2);
    }
    return path;
  }

  planning::Toolpath with_dwells(planning::Toolpath path) {
    for (int i = 0; i < 3; ++i) path.segments[random_() % path.segments.size()].dwell = std::pow(10, uniform(-3, 0));
    return path;
  }

  // Each marker comes once, in order, where the plan has it.
  void take_markers(const Batch& batch, bool stops) {
    if (plan_.markers.size() > runs::kMostMarkers) return;  // some may be left out
    std::size_t setpoint = 0;
    for (const runs::BatchMarker& due : batch.markers) {
      const bool in_tail = due.setpoint >= batch.positions.size();
      if (in_tail && !stops) continue;
      ASSERT_LT(next_marker_, plan_.markers.size());
      const planning::MarkerAt& expected = plan_.markers[next_marker_++];
      ASSERT_EQ(due.marker, expected.marker);
      ASSERT_GE(due.setpoint, setpoint);
      setpoint = due.setpoint;
      if (due.marker.kind == planning::MarkerKind::kDwellBegins) dwell_ = {expected.time, tick_ + due.setpoint};
      if (due.marker.kind == planning::MarkerKind::kDwellEnds) expect_dwell(expected.time, tick_ + due.setpoint);
      ASSERT_LE(expected.time, in_tail ? batch.tail_end : batch.end.plan_time);
      ASSERT_GE(expected.time, in_tail ? batch.end.plan_time : state_.plan_time);
    }
    const double end = stops ? batch.tail_end : batch.end.plan_time;
    const bool is_left = next_marker_ < plan_.markers.size();
    ASSERT_TRUE(!is_left || (!batch.end_of_plan && plan_.markers[next_marker_].time >= end)) << "one was lost";
    markers += batch.markers.size();
  }

  // As long as programmed, whatever the pace; but at the override 0 its end waits.
  void expect_dwell(double end, std::uint64_t tick) {
    if (!dwell_) return;  // the run began in it
    const double taken = static_cast<double>(tick - dwell_->tick) * period_;
    if (!waited_) {
      ASSERT_NEAR(taken, end - dwell_->begin, period_ * (1 + 1e-6)) << "from " << dwell_->begin << " s on";
    }
    dwell_.reset();
    ++dwells;
  }

  void expect_at(double plan_time) {
    const Vector there = runs::position(window_, plan_time);
    const double rounding = 1e-9 + 1e-14 * there.cwiseAbs().maxCoeff();
    ASSERT_LE((drives_.position() - there).norm(), rounding) << "at " << plan_time << " s";
  }

  std::mt19937_64 random_;
  planning::Plan plan_;
  double period_;
  runs::PlanWindow window_;
  ClockState state_;
  Drives drives_;
  runs::BatchMaker batches_;
  double rate_ = 1;
  bool ended_ = false;
  std::size_t next_marker_ = 0;
  std::uint64_t tick_ = 0;      // of the next batch's first setpoint
  std::optional<Dwell> dwell_;  // begun
  bool waited_ = false;         // meanwhile
};

// From the highest speed of each axis. Among random machines are some that would need hours.
double longest_stop(const motion::AxisLimits& limits) {
  const auto axes = static_cast<Eigen::Index>(limits.axes);
  const auto of = [axes](const Vector& vector) { return vector.head(axes).array(); };
  return (of(limits.velocity) / of(limits.acceleration) + of(limits.acceleration) / of(limits.jerk)).maxCoeff();
}

// The number of dwells that were seen whole.
std::uint64_t run(Case (*make)(std::uint64_t seed), std::uint64_t count) {
  constexpr double kMostStop = 1;  // s
  std::uint64_t tails = 0, markers = 0, dwells = 0;
  for (std::uint64_t seed = 0, taken = 0; taken < count; ++seed) {
    const Case problem = make(seed);
    if (longest_stop(problem.options.limits) > kMostStop) continue;
    ++taken;
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Run one(problem, seed);
    one.go();
    tails += one.tails;
    markers += one.markers;
    dwells += one.dwells;
    if (testing::Test::HasFailure()) return dwells;
  }
  EXPECT_GT(markers, 0u);
  std::printf("%llu stop tails, %llu dwells\n", static_cast<unsigned long long>(tails),
              static_cast<unsigned long long>(dwells));
  return dwells;
}

TEST(Runs, KeepTheLimitsOnRandomPaths) { EXPECT_GT(run(random_case, 1'000), 0u); }
TEST(Runs, KeepTheLimitsOnDensePaths) { EXPECT_GT(run(dense_case, 100), 0u); }
TEST(Runs, KeepTheLimitsOnLongPaths) { run(long_case, 20); }

}  // namespace
}  // namespace kcs::test
