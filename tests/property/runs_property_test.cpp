// Runs of random plans at random paces, stopped and resumed at random: what the drives would see.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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
        plan_(planning::plan(problem.path, problem.options)),
        period_(std::pow(10, uniform(-4, -2))),
        window_(plan_.trajectory),
        state_{.plan_time = chance(0.3) ? 0 : uniform(0, plan_.trajectory.duration())},
        drives_(problem.options.limits, period_, runs::position(window_, state_.plan_time)),
        batches_(plan_.trajectory, problem.options.limits,
                 {.period = period_, .setpoints = static_cast<std::size_t>(uniform(1, 40)), .tail_capacity = 100'000}) {
  }

  void go() {
    for (int i = 0; i < 60 && !ended_; ++i) {
      if (chance(0.15)) rate_ = chance(0.5) ? uniform(0, 1) : uniform(1, 2);
      if (chance(0.1)) rate_ = chance(0.5) ? 1 : 0;
      play_batch(chance(0.1));
      if (testing::Test::HasFatalFailure()) return;
    }
  }

  std::uint64_t tails = 0;

 private:
  double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  bool chance(double share) { return uniform(0, 1) < share; }

  void play_batch(bool stop) {
    const auto batch = batches_.next(state_, rate_);
    ASSERT_TRUE(batch) << "no way on from " << state_.plan_time << " s at " << state_.rate;
    for (const Vector& position : batch->positions) drives_.take(position);
    ASSERT_GE(batch->end.plan_time, state_.plan_time);
    ASSERT_GE(batch->tail_end, batch->end.plan_time);
    expect_at(batch->end.plan_time);
    state_ = batch->end;
    ended_ = batch->end_of_plan;
    Drives stopping = drives_;
    for (const Vector& position : batch->tail) stopping.take(position);
    stopping.rest();
    ++tails;
    if (!stop) return;
    drives_ = stopping;
    state_ = {batch->tail_end, 0, 0};
    expect_at(state_.plan_time);
    ended_ = false;
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
};

// From the highest speed of each axis. Among random machines are some that would need hours.
double longest_stop(const motion::AxisLimits& limits) {
  const auto axes = static_cast<Eigen::Index>(limits.axes);
  const auto of = [axes](const Vector& vector) { return vector.head(axes).array(); };
  return (of(limits.velocity) / of(limits.acceleration) + of(limits.acceleration) / of(limits.jerk)).maxCoeff();
}

void run(Case (*make)(std::uint64_t seed), std::uint64_t count) {
  constexpr double kMostStop = 1;  // s
  std::uint64_t tails = 0;
  for (std::uint64_t seed = 0, taken = 0; taken < count; ++seed) {
    const Case problem = make(seed);
    if (longest_stop(problem.options.limits) > kMostStop) continue;
    ++taken;
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Run one(problem, seed);
    one.go();
    tails += one.tails;
    if (testing::Test::HasFailure()) return;
  }
  std::printf("%llu stop tails\n", static_cast<unsigned long long>(tails));
}

TEST(Runs, KeepTheLimitsOnRandomPaths) { run(random_case, 1'000); }
TEST(Runs, KeepTheLimitsOnDensePaths) { run(dense_case, 100); }
TEST(Runs, KeepTheLimitsOnLongPaths) { run(long_case, 20); }

}  // namespace
}  // namespace kcs::test
