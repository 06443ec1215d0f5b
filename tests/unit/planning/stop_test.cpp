// Planning can be stopped at any time, and tells how far it has come.
#include <gtest/gtest.h>
#include <pthread.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <ctime>
#include <ostream>
#include <random>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>

#include "server/planning/plan_path.h"
#include "server/planning/planner.h"
#include "server/planning/stopped.h"
#include "tests/unit/planning/sanitizers.h"

namespace kcs::planning {
namespace {

constexpr double kSlowdown = kSanitizer ? 15 : 1;

template <class Point>
Toolpath path_of(std::size_t segments, double tolerance, Point point) {
  constexpr double kFeed = 100;  // mm/s
  Toolpath path;
  path.start = point(0);
  for (std::size_t i = 1; i <= segments; ++i) {
    path.segments.push_back({.end = point(static_cast<double>(i)), .feed = kFeed, .tolerance = tolerance});
  }
  return path;
}

// Turns 0.05 mm apart, every point off by up to 5 µm.
Toolpath noisy_spiral() {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> noise(-0.005, 0.005);
  return path_of(20'000, 0.005, [&](double i) -> Vector {
    const double angle = 6 + std::sqrt(5 * i), radius = angle * 0.05 / 6.3;
    return {radius * std::cos(angle) + noise(random), radius * std::sin(angle) + noise(random), 0};
  });
}

Toolpath zigzag(std::size_t segments, double step, double width, double tolerance) {
  return path_of(segments, tolerance, [&](double i) -> Vector { return {step * i, std::fmod(i, 2) * width, 0}; });
}
Toolpath crowded_zigzag() { return zigzag(20'000, 0.05, 0.05, 0.01); }
Toolpath million_points() { return zigzag(1'000'000, 0.3, 0.001, 0.01); }
Toolpath many_legs_within_the_tolerance() { return zigzag(60'000, 0.01, 0.001, 100); }
Toolpath storm_of_tiny_legs() { return zigzag(60'000, 1e-4, 1e-6, 1); }

struct HardCase {
  const char* name;
  Toolpath (*make)();
  CornerStrategy strategy;
};
void PrintTo(const HardCase& hard, std::ostream* out) { *out << hard.name; }

PlanOptions options_with(CornerStrategy strategy, std::stop_token stop = {}) {
  return {.limits = {2, Vector::Constant(500), Vector::Constant(2000), Vector::Constant(1e5)},
          .strategy = strategy,
          .stop = std::move(stop)};
}

// Processor time, which does not pass while a busy machine does other things.
double seconds_on(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Plans in a thread of its own, asks it to stop after so much of its time, and tells how much more it took; 0 if it
// was done before.
double time_to_stop(const Toolpath& path, CornerStrategy strategy, double after) {
  double ended = 0;
  std::atomic<bool> done = false;
  std::jthread planning([&](const std::stop_token& stop) {
    try {
      plan(path, options_with(strategy, stop));
    } catch (const Stopped&) {
      ended = seconds_on(CLOCK_THREAD_CPUTIME_ID);
    }
    done = true;
    while (!stop.stop_requested()) std::this_thread::yield();  // so that there is a clock to be read
  });
  clockid_t clock{};
  pthread_getcpuclockid(planning.native_handle(), &clock);
  while (!done && seconds_on(clock) < after) std::this_thread::sleep_for(std::chrono::microseconds(200));
  planning.request_stop();
  // Read too late rather than too early: what this thread is kept waiting must not count.
  const double asked = seconds_on(clock);
  planning.join();
  return ended > 0 ? ended - asked : 0;
}

class StoppingOnHardPaths : public testing::TestWithParam<HardCase> {};

TEST_P(StoppingOnHardPaths, TakesLessThanFiftyMilliseconds) {
  const Toolpath path = GetParam().make();
  for (const double after : {0.002, 0.02, 0.08, 0.3}) {
    EXPECT_LT(time_to_stop(path, GetParam().strategy, after * kSlowdown), 0.05 * kSlowdown)
        << "after " << after << " s";
  }
}

INSTANTIATE_TEST_SUITE_P(
    AllKinds, StoppingOnHardPaths,
    testing::Values(HardCase{"NoisySpiral", noisy_spiral, CornerStrategy::kAuto},
                    HardCase{"NoisySpiralBlended", noisy_spiral, CornerStrategy::kBlended},
                    HardCase{"CrowdedZigzag", crowded_zigzag, CornerStrategy::kAuto},
                    HardCase{"CrowdedZigzagInterrupted", crowded_zigzag, CornerStrategy::kInterrupted},
                    HardCase{"CrowdedZigzagUninterrupted", crowded_zigzag, CornerStrategy::kUninterrupted},
                    HardCase{"CrowdedZigzagExactStop", crowded_zigzag, CornerStrategy::kExactStop},
                    HardCase{"CrowdedZigzagBlended", crowded_zigzag, CornerStrategy::kBlended},
                    HardCase{"MillionPoints", million_points, CornerStrategy::kAuto},
                    HardCase{"ManyLegsWithinTheTolerance", many_legs_within_the_tolerance, CornerStrategy::kAuto},
                    HardCase{"StormOfTinyLegs", storm_of_tiny_legs, CornerStrategy::kAuto},
                    HardCase{"StormOfTinyLegsBlended", storm_of_tiny_legs, CornerStrategy::kBlended}),
    [](const auto& hard) { return std::string(hard.param.name); });

TEST(Stopping, BeforeTheBeginningPlansNothing) {
  std::stop_source stop;
  stop.request_stop();
  const Toolpath path = zigzag(10, 1, 1, 0.01);
  EXPECT_THROW(plan(path, options_with(CornerStrategy::kAuto, stop.get_token())), Stopped);
}

TEST(Planner, TellsMoreAndMoreSegmentsUntilAllArePlanned) {
  Toolpath path = zigzag(2000, 1, 1, 0.01);
  path.segments.insert(path.segments.begin() + 1000, path.segments[999]);  // one of no length
  Planner planner(path, options_with(CornerStrategy::kAuto));
  std::size_t before = 0, changes = 0;
  while (planner.go_on()) {
    ASSERT_GE(planner.segments_planned(), before);
    if (planner.segments_planned() > before) ++changes;
    before = planner.segments_planned();
  }
  EXPECT_GT(changes, 10U);
  EXPECT_EQ(planner.segments_planned(), 2001U);
  EXPECT_EQ(planner.take_plan().summary.segments, 2000U);
}

}  // namespace
}  // namespace kcs::planning
