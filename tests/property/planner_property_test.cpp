// What must hold for every plan, tried on many random paths, and judged here by means of its own: plain sampling and
// plain geometry, not the verifier that the planner itself uses.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <thread>
#include <vector>

#include "server/motion/sampler.h"
#include "server/planning/planner.h"
#include "tests/property/random_case.h"

namespace kcs::test {
namespace {

using motion::Phase;
using motion::State;
using motion::Vector;
using planning::CornerStrategy;
using planning::Plan;

constexpr std::uint64_t kShards = 8;

// KCS_CASES in the environment asks for more (or fewer).
std::uint64_t cases_per_shard() {
  const char* wanted = std::getenv("KCS_CASES");
  return (wanted != nullptr ? std::strtoull(wanted, nullptr, 10) : 24'000) / kShards;
}

// No limit is exceeded by more than rounding.
constexpr double kLimit = 1 + 1e-9;

// The distance from a point to the nearest place of the whole path, not only of the segments that a phase names.
double distance_to_path(const Vector& point, const planning::Toolpath& path) {
  double nearest = INFINITY;
  for (std::size_t i = 0; i < path.segments.size(); ++i) {
    const Vector from = path.start_of(i), along = path.segments[i].end - from;
    const double square = along.squaredNorm();
    const double share = square > 0 ? std::clamp((point - from).dot(along) / square, 0.0, 1.0) : 0;
    nearest = std::min(nearest, (point - from - share * along).norm());
  }
  return nearest;
}

// The segments of the case that count, as phases number them.
std::vector<planning::Segment> moving_segments(const planning::Toolpath& path) {
  std::vector<planning::Segment> result;
  for (std::size_t i = 0; i < path.segments.size(); ++i) {
    if ((path.segments[i].end - path.start_of(i)).norm() >= planning::kNoLength) result.push_back(path.segments[i]);
  }
  return result;
}

class Judge {
 public:
  Judge(const Case& problem, const Plan& plan)
      : problem_(problem), plan_(plan), segments_(moving_segments(problem.path)) {
    for (const auto& segment : problem.path.segments) {
      rounding_ = std::max(rounding_, 1e-15 * segment.end.cwiseAbs().maxCoeff());
    }
  }

  void run() {
    State at{.position = problem_.path.start};
    double time = 0;
    for (const Phase& phase : plan_.trajectory.phases) {
      ASSERT_GT(phase.duration, 0);
      ASSERT_EQ(phase.start_time, time);
      continuous(at, phase.start);
      for (int i = 0; i <= 8; ++i) inside_limits(phase, phase.at(phase.duration * i / 8));
      at = phase.at(phase.duration);
      time = phase.end_time();
    }
    State end;
    end.position = problem_.path.segments.back().end;
    continuous(at, end);
    EXPECT_LE((plan_.trajectory.end - end.position).norm(), 1e-9);
    stops_are_reached();
    corners_keep_their_tolerance();
  }

 private:
  void continuous(const State& before, const State& after) {
    const auto& limits = problem_.options.limits;
    EXPECT_LE((after.position - before.position).norm(), 1e-9 + 16 * rounding_);
    for (std::size_t axis = 0; axis < limits.axes; ++axis) {
      EXPECT_LE(std::abs(after.velocity[axis] - before.velocity[axis]), 1e-9 * limits.velocity[axis]);
      EXPECT_LE(std::abs(after.acceleration[axis] - before.acceleration[axis]), 1e-9 * limits.acceleration[axis]);
    }
  }

  void inside_limits(const Phase& phase, const State& state) {
    const auto& limits = problem_.options.limits;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool exists = axis < limits.axes;
      EXPECT_LE(std::abs(state.velocity[axis]), exists ? limits.velocity[axis] * kLimit : 0);
      EXPECT_LE(std::abs(state.acceleration[axis]), exists ? limits.acceleration[axis] * kLimit : 0);
      EXPECT_LE(std::abs(phase.jerk[axis]), exists ? limits.jerk[axis] * kLimit : 0);
    }
    double feed = INFINITY, tolerance = 0;
    for (std::size_t i = phase.segments.first; i <= phase.segments.last && !segments_.empty(); ++i) {
      feed = std::min(feed, segments_.at(i).feed);
      tolerance = std::max(tolerance, segments_[i].tolerance);
    }
    EXPECT_LE(state.velocity.norm(), feed * kLimit);
    EXPECT_LE(distance_to_path(state.position, problem_.path), tolerance + 16 * rounding_);
  }

  void stops_are_reached() {
    for (const auto& segment : problem_.path.segments) {
      if (!segment.stop && segment.dwell == 0) continue;
      double nearest = (plan_.trajectory.end - segment.end).norm();
      for (const Phase& phase : plan_.trajectory.phases) {
        if (phase.start.velocity.norm() <= 1e-9 * problem_.options.limits.velocity.maxCoeff()) {
          nearest = std::min(nearest, (phase.start.position - segment.end).norm());
        }
      }
      EXPECT_LE(nearest, 2e-9 + 16 * rounding_);
    }
  }

  // The corner distance is not something that the contour error shows.
  void corners_keep_their_tolerance() {
    for (const auto& corner : plan_.corners) {
      ASSERT_LT(corner.segment + 1, segments_.size());
      const double tolerance = std::min(segments_[corner.segment].tolerance, segments_[corner.segment + 1].tolerance);
      const bool contour = problem_.options.tolerance_kind == planning::ToleranceKind::kContourError;
      EXPECT_LE(corner.corner_distance, tolerance * (contour ? 4 : 1));
      EXPECT_LE(corner.contour_error, tolerance);
      double nearest = INFINITY;
      for (const Phase& phase : plan_.trajectory.phases) {
        if (phase.segments.last < corner.segment || phase.segments.first > corner.segment + 1) continue;
        for (int i = 0; i <= 8; ++i) {
          nearest = std::min(nearest, (phase.at(phase.duration * i / 8).position - corner.point).norm());
        }
      }
      // Sampling finds the middle of the corner exactly: it is the middle, the quarter or an end of a phase.
      EXPECT_LE(nearest, corner.corner_distance * (1 + 1e-6) + 16 * rounding_ + 1e-12);
    }
  }

  const Case& problem_;
  const Plan& plan_;
  std::vector<planning::Segment> segments_;
  double rounding_ = 1e-15;
};

class RandomPaths : public testing::TestWithParam<std::uint64_t> {};

TEST_P(RandomPaths, KeepEveryPromise) {
  const std::uint64_t count = cases_per_shard(), first = GetParam() * count;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const Case problem = random_case(seed);
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    try {
      const Plan plan = planning::plan(problem.path, problem.options);
      Judge(problem, plan).run();
    } catch (const std::exception& error) {
      ADD_FAILURE() << "a valid path was refused: " << error.what();
    }
    if (testing::Test::HasFailure()) FAIL() << describe(problem);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomPaths, testing::Range<std::uint64_t>(0, kShards));

bool same_bytes(const Plan& a, const Plan& b) {
  const auto& p = a.trajectory.phases;
  const auto& q = b.trajectory.phases;
  if (p.size() != q.size() || a.corners.size() != b.corners.size()) return false;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto numbers = [](const Phase& phase) {
      const State& s = phase.start;
      return std::vector<double>{phase.start_time,  phase.duration, s.position[0], s.position[1],     s.position[2],
                                 s.velocity[0],     s.velocity[1],  s.velocity[2], s.acceleration[0], s.acceleration[1],
                                 s.acceleration[2], phase.jerk[0],  phase.jerk[1], phase.jerk[2]};
    };
    const auto x = numbers(p[i]), y = numbers(q[i]);
    if (std::memcmp(x.data(), y.data(), x.size() * sizeof(double)) != 0) return false;
  }
  return std::memcmp(&a.summary, &b.summary, sizeof(a.summary)) == 0;
}

TEST(Determinism, TwoThreadsPlanTheSameBytesAsOne) {
  constexpr std::uint64_t kSome = 2'000;
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

TEST(Auto, TakesNoLongerThanEitherStrategyAlone) {
  for (std::uint64_t seed = 0; seed < 4'000; ++seed) {
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
