// What must hold for every plan, tried on many random paths.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "server/planning/invalid_input.h"
#include "server/planning/leg.h"
#include "server/planning/plan_path.h"
#include "tests/property/dense_case.h"
#include "tests/property/judge.h"
#include "tests/property/long_case.h"
#include "tests/property/random.h"
#include "tests/property/random_case.h"

namespace kcs::test {
namespace {

using motion::Phase;
using motion::State;
using planning::CornerStrategy;
using planning::Plan;

// Cases of a suite; KCS_CASES in the environment asks for more (or fewer) of all.
std::uint64_t cases(std::uint64_t usual) {
  constexpr std::uint64_t kUsual = 24'000;
  const char* wanted = std::getenv("KCS_CASES");
  return wanted != nullptr ? usual * std::strtoull(wanted, nullptr, 10) / kUsual : usual;
}

// The cases of one shard of a suite, with what to change in each; ends with the first that fails.
void keep_every_promise(
    Case (*make)(std::uint64_t seed), std::uint64_t shard, std::uint64_t count, void (*change)(Case&) = [](Case&) {}) {
  for (std::uint64_t seed = shard * count; seed < (shard + 1) * count; ++seed) {
    Case problem = make(seed);
    change(problem);
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    try {
      judge(problem, planning::plan(problem.path, problem.options));
    } catch (const std::exception& error) {
      ADD_FAILURE() << "a valid path was refused: " << error.what();
    }
    if (testing::Test::HasFailure()) FAIL() << describe(problem);
  }
}

// Lets a path begin and end in motion, more or less as fast as it may.
void in_motion(Case& problem, std::uint64_t seed) {
  Random random(seed);
  const auto& limits = problem.options.limits;
  planning::Toolpath& path = problem.path;
  const auto most = [&](const planning::Vector& from, const planning::Segment& segment) {
    const planning::Vector direction = (segment.end - from).normalized();
    return std::pair(std::min(segment.feed, planning::along(limits.velocity, direction, limits.axes)),
                     planning::along(limits.acceleration, direction, limits.axes));
  };
  const auto [speed, acceleration] = most(path.start, path.segments.front());
  if (random.chance(0.7) && std::isfinite(speed)) {
    path.start_speed = random.log_uniform(1e-3, 1) * speed;
    if (random.chance(0.5)) path.start_acceleration = random.uniform(-0.1, 0.1) * acceleration;
  }
  const std::size_t last = path.segments.size() - 1;
  const double end = most(path.start_of(last), path.segments[last]).first;
  if (!path.segments[last].stop && std::isfinite(end)) path.end_speed = random.log_uniform(1e-3, 1) * end;
}

constexpr std::uint64_t kRandomShards = 8, kBlendedShards = 1, kDenseShards = 8, kLongShards = 4;

class RandomPaths : public testing::TestWithParam<std::uint64_t> {};

TEST_P(RandomPaths, KeepEveryPromise) { keep_every_promise(random_case, GetParam(), cases(24'000) / kRandomShards); }

INSTANTIATE_TEST_SUITE_P(Seeds, RandomPaths, testing::Range<std::uint64_t>(0, kRandomShards));

class BlendedPaths : public testing::TestWithParam<std::uint64_t> {};

TEST_P(BlendedPaths, KeepEveryPromise) {
  keep_every_promise(random_case, GetParam(), cases(2'000) / kBlendedShards,
                     [](Case& problem) { problem.options.strategy = CornerStrategy::kBlended; });
}

INSTANTIATE_TEST_SUITE_P(Seeds, BlendedPaths, testing::Range<std::uint64_t>(0, kBlendedShards));

class DensePaths : public testing::TestWithParam<std::uint64_t> {};

TEST_P(DensePaths, KeepEveryPromise) { keep_every_promise(dense_case, GetParam(), cases(400) / kDenseShards); }

INSTANTIATE_TEST_SUITE_P(Dense, DensePaths, testing::Range<std::uint64_t>(0, kDenseShards));

class LongPaths : public testing::TestWithParam<std::uint64_t> {};

TEST_P(LongPaths, KeepEveryPromise) { keep_every_promise(long_case, GetParam(), cases(60) / kLongShards); }

INSTANTIATE_TEST_SUITE_P(Long, LongPaths, testing::Range<std::uint64_t>(0, kLongShards));

// A section ended in a tangle smaller than the tolerance; a corner's record was written too soon; the tool went back by
// some tolerances; a stretch went on beyond the leg where it had to end; a record named what no phase of its corner did.
TEST(PathsThatOnceFailed, KeepEveryPromise) {
  keep_every_promise(long_case, 133, 1);
  keep_every_promise(dense_case, 2359, 1);
  keep_every_promise(dense_case, 443, 1);
  keep_every_promise(dense_case, 491, 1);
  keep_every_promise(long_case, 79, 1);
}

// Paths that go on from a motion and lead into one. Not every one can: then it says so.
TEST(PathsInMotion, KeepEveryPromise) {
  const std::uint64_t count = cases(4'000);
  std::uint64_t planned = 0;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    Case problem = seed % 8 == 0 ? dense_case(seed) : random_case(seed);
    in_motion(problem, seed);
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    try {
      judge(problem, planning::plan(problem.path, problem.options));
      ++planned;
    } catch (const planning::InvalidInput&) {
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what();
    }
    if (testing::Test::HasFailure()) FAIL() << describe(problem);
  }
  EXPECT_GT(2 * planned, count);
}

// Else the suite above says nothing about them.
TEST(DenseCases, AreMostlyTravelledInSmoothMotions) {
  std::size_t corners = 0, overlapping = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Case problem = dense_case(seed);
    const Plan plan = planning::plan(problem.path, problem.options);
    corners += plan.corners.size();
    overlapping += plan.summary.overlapping;
  }
  EXPECT_GT(2 * overlapping, corners);
}

bool same_bytes(const Plan& a, const Plan& b) {
  if (a.trajectory.size() != b.trajectory.size() || a.corners.size() != b.corners.size()) return false;
  auto p = a.trajectory.begin(), q = b.trajectory.begin();
  for (; p != a.trajectory.end(); ++p, ++q) {
    const auto numbers = [](const Phase& phase) {
      const State& s = phase.start;
      return std::vector<double>{phase.start_time,  phase.duration, s.position[0], s.position[1],     s.position[2],
                                 s.velocity[0],     s.velocity[1],  s.velocity[2], s.acceleration[0], s.acceleration[1],
                                 s.acceleration[2], phase.jerk[0],  phase.jerk[1], phase.jerk[2]};
    };
    const auto x = numbers(*p), y = numbers(*q);
    if (std::memcmp(x.data(), y.data(), x.size() * sizeof(double)) != 0) return false;
  }
  return std::memcmp(&a.summary, &b.summary, sizeof(a.summary)) == 0;
}

TEST(Determinism, TwoThreadsPlanTheSameBytesAsOne) {
  constexpr std::uint64_t kSome = 1'000;
  std::vector<Plan> alone, together(kSome);
  for (std::uint64_t seed = 0; seed < kSome; ++seed) {
    const Case problem = random_case(seed);
    alone.push_back(planning::plan(problem.path, problem.options));
  }
  std::atomic<std::uint64_t> next{0};
  const auto work = [&] {
    for (std::uint64_t seed = next++; seed < kSome; seed = next++) {
      const Case problem = random_case(seed);
      together[seed] = planning::plan(problem.path, problem.options);
    }
  };
  std::thread first(work), second(work);
  first.join();
  second.join();
  for (std::uint64_t seed = 0; seed < kSome; ++seed) {
    EXPECT_TRUE(same_bytes(alone[seed], together[seed])) << "seed " << seed;
  }
}

TEST(Determinism, DensePathsAreTheSameBytesAgain) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Case problem = dense_case(seed);
    const auto planned = [&] { return planning::plan(problem.path, problem.options); };
    EXPECT_TRUE(same_bytes(planned(), planned())) << "seed " << seed;
  }
}

TEST(Auto, TakesNoLongerThanEitherStrategyAlone) {
  for (std::uint64_t seed = 0; seed < 1'000; ++seed) {
    Case problem = random_case(seed);
    const auto time = [&](CornerStrategy strategy) {
      problem.options.strategy = strategy;
      return planning::plan(problem.path, problem.options).summary.cycle_time;
    };
    const double both = std::min(time(CornerStrategy::kInterrupted), time(CornerStrategy::kUninterrupted));
    EXPECT_LE(time(CornerStrategy::kAuto), both * (1 + 1e-9)) << "seed " << seed;
    EXPECT_LE(time(CornerStrategy::kAuto), time(CornerStrategy::kExactStop) * (1 + 1e-9)) << "seed " << seed;
  }
}

}  // namespace
}  // namespace kcs::test
