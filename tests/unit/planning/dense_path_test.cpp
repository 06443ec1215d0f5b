// Curves in many short legs, through the whole planner.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/unit/planning/paths.h"
#include "tests/unit/planning/sanitizers.h"

namespace kcs::planning {
namespace {

using motion::Phase;
using testing::Each;
using testing::Field;

constexpr double kTolerance = 0.01, kFeed = 100, kAcceleration = 2000, kJerk = 1e5;
constexpr std::size_t kChords = 628;
constexpr double kRounding = 1 + 1e-9;

PlanOptions dense_options(CornerStrategy strategy = CornerStrategy::kAuto,
                          ToleranceKind kind = ToleranceKind::kContourError) {
  return options_for(kAcceleration, kJerk, kind, strategy);
}

// From zero, of 10 mm radius, about (0, 10).
Toolpath circle() {
  Toolpath path;
  for (std::size_t i = 1; i <= kChords; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / kChords;
    const Vector end(10 * std::sin(angle), 10 - 10 * std::cos(angle), 0);
    path.segments.push_back({.end = end, .feed = kFeed, .tolerance = kTolerance});
  }
  return path;
}

// With 30 mm straight before it and after it.
Toolpath circle_with_leads() {
  Toolpath path = circle();
  path.start = Vector(-30, 0, 0);
  const Segment lead{.end = Vector::Zero(), .feed = kFeed, .tolerance = kTolerance};
  path.segments.insert(path.segments.begin(), lead);
  path.segments.push_back(lead);
  path.segments.back().end = Vector(30, 0, 0);
  return path;
}

// Where two long legs at the feed begin and end at rest: half of what an exact stop costs, twice, s.
constexpr double kStartAndEnd = kFeed / kAcceleration + kAcceleration / kJerk;

double distance_to_path(const Vector& point, const Toolpath& path) {
  double nearest = INFINITY;
  for (std::size_t i = 0; i < path.segments.size(); ++i) {
    const Vector from = path.start_of(i), along = path.segments[i].end - from;
    const double share = std::clamp((point - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (point - from - share * along).norm());
  }
  return nearest;
}

// At the beginning, the middle and the end of each phase that follows one of these segments.
template <class Look>
void look_at(const Plan& plan, std::size_t first, std::size_t last, const Look& look) {
  for (const Phase& phase : plan.trajectory) {
    if (phase.segments.last < first || phase.segments.first > last) continue;
    for (const double share : {0.0, 0.5, 1.0}) look(phase, phase.at(share * phase.duration));
  }
}

void expect_feed(const Plan& plan, std::size_t first, std::size_t last, double feed) {
  look_at(plan, first, last,
          [&](const Phase&, const motion::State& state) { EXPECT_LE(state.velocity.norm(), feed * kRounding); });
}

void expect_kept(const Plan& plan, const PlanOptions& options) {
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_LE(plan.summary.max_acceleration[axis], options.limits.acceleration[axis] * kRounding);
    EXPECT_LE(plan.summary.max_jerk[axis], options.limits.jerk[axis] * kRounding);
  }
}

TEST(DensePath, IsTravelledAtTheFeed) {
  const Plan result = plan(circle(), dense_options());
  EXPECT_LE(result.summary.cycle_time, 0.72);
  EXPECT_GE(result.summary.cycle_time, result.summary.path_length / kFeed);
  EXPECT_THAT(result.corners, Each(Field(&Corner::strategy, CornerStrategy::kOverlapping)));
  EXPECT_EQ(result.summary.overlapping, kChords - 1);
  EXPECT_LE(result.summary.max_feed, kFeed * kRounding);
  EXPECT_LE(result.summary.max_contour_error, kTolerance);
  EXPECT_GT(result.summary.time_at_feed, 0);
  EXPECT_LT(result.summary.time_at_feed, result.summary.cycle_time);
  expect_kept(result, dense_options());
}

TEST(DensePath, DoesNotStutter) {
  const Plan result = plan(circle(), dense_options());
  for (std::size_t i = 60; i + 60 < result.corners.size(); ++i) EXPECT_GT(result.corners[i].speed, 95) << i;
}

// Where one section goes on from another, no search that finds nothing may show as a place where the tool brakes.
TEST(DensePath, DoesNotBrakeWhereSectionsMeet) {
  constexpr std::size_t kPass = 500, kPasses = 40, kTurning = 60;  // segments of a pass; of its ends, where it turns
  constexpr double kWave = 2 * std::numbers::pi / 20;              // rad/mm
  Toolpath relief;
  for (std::size_t i = 0; i < kPasses * (kPass + 1); ++i) {
    const std::size_t pass = i / (kPass + 1), along = i % (kPass + 1);
    const double x = 0.2 * static_cast<double>(pass % 2 == 0 ? along : kPass - along);
    const double y = 0.3 * static_cast<double>(pass);
    const Vector end(x, y, 3 * std::sin(kWave * x) * std::cos(kWave * y));
    if (i > 0) relief.segments.push_back({.end = end, .feed = kFeed, .tolerance = 0.05});
  }
  PlanOptions options = dense_options();
  options.limits.axes = 3;
  const Plan result = plan(relief, options);
  for (const Corner& corner : result.corners) {
    const std::size_t along = corner.segment % (kPass + 1);
    if (along < kTurning || along > kPass - kTurning) continue;
    EXPECT_GT(corner.speed, 80) << corner.segment;
  }
}

// A pocket's outline: lines, and fillets in short chords between them.
TEST(DensePath, DoesNotBrakeInFilletsBetweenLines) {
  constexpr double kRadius = 1.6, kChord = 0.09, kLine = 3, kTurn = kChord / kRadius;
  Toolpath outline;
  Vector end = Vector::Zero();
  double angle = 0;
  const auto go = [&](double length) {
    end += length * Vector(std::cos(angle), std::sin(angle), 0);
    outline.segments.push_back({.end = end, .feed = kFeed, .tolerance = kTolerance});
  };
  for (int fillet = 0; fillet < 40; ++fillet) {
    go(kLine + 0.1 * fillet);
    const int chords = 10 + fillet % 7;
    const double turn = fillet % 2 == 0 ? kTurn : -kTurn;
    for (int i = 0; i < chords; ++i) {
      angle += i == 0 ? turn / 2 : turn;
      go(kChord);
    }
    angle += turn / 2;
  }
  go(kLine);
  const Plan result = plan(outline, dense_options());
  const double in_a_circle = std::sqrt(kAcceleration * kRadius);
  for (const Corner& corner : result.corners) EXPECT_GT(corner.speed, 0.65 * in_a_circle) << corner.segment;
}

// One smooth motion through them all would stay a little below the feed.
TEST(DensePath, CornersThatCostNothingAreTakenOneByOne) {
  constexpr double kSlow = 12;  // mm/s
  Toolpath curve = turning_legs(400, 0.5, 3);
  for (Segment& segment : curve.segments) segment.feed = kSlow;
  const Plan result = plan(curve, dense_options());
  EXPECT_EQ(result.summary.overlapping, 0);
  EXPECT_LT(result.summary.cycle_time, 1.001 * result.summary.path_length / kSlow + 2 * std::sqrt(kSlow / kJerk));
}

// As CAM software leaves them where it joins what it reckoned apart.
TEST(DensePath, JogsFarBelowTheToleranceCostNoTime) {
  Toolpath smooth, jogged;
  for (int i = 1; i <= 2000; ++i) {
    const double angle = i * 0.2 / 40;  // on a circle of 40 mm
    const Vector end(40 * std::sin(angle), 40 - 40 * std::cos(angle), 0);
    smooth.segments.push_back({.end = end, .feed = kFeed, .tolerance = kTolerance});
    jogged.segments.push_back(smooth.segments.back());
    if (i % 3 > 0) continue;
    jogged.segments.push_back(jogged.segments.back());
    jogged.segments.back().end += 3e-4 * Vector(std::sin(angle), -std::cos(angle), 0);
  }
  const auto time = [](const Toolpath& path) { return plan(path, dense_options()).summary.cycle_time; };
  EXPECT_LT(time(jogged), 1.002 * time(smooth));
}

// What suits one kind of path must not be kept where the next kind begins: it would cost more than a stop there.
TEST(DensePath, IsNoSlowerBesideSharpCorners) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> length(0.5, 3), turn(0.5, 2);
  std::bernoulli_distribution left;
  Toolpath whole, part;
  double angle = 0, parts = 0;
  for (int block = 0; block < 8; ++block) {
    const bool dense = block % 2 == 0;
    for (int i = 0; i < (dense ? 1200 : 150); ++i) {
      angle += dense ? 0.05 / 8 : (left(random) ? 1 : -1) * turn(random);
      const double leg = dense ? 0.05 : length(random);
      const Vector before = whole.segments.empty() ? whole.start : whole.segments.back().end;
      const Vector end = before + leg * Vector(std::cos(angle), std::sin(angle), 0);
      whole.segments.push_back({.end = end, .feed = kFeed, .tolerance = kTolerance});
      part.segments.push_back(whole.segments.back());
    }
    parts += plan(part, dense_options()).summary.cycle_time;
    part.start = whole.segments.back().end;
    part.segments.clear();
  }
  EXPECT_LT(plan(whole, dense_options()).summary.cycle_time, parts);
}

TEST(DensePath, IsTakenCornerByCornerWhereAStrategyIsAskedFor) {
  for (const auto strategy : {CornerStrategy::kInterrupted, CornerStrategy::kUninterrupted, CornerStrategy::kBlended}) {
    const Plan result = plan(circle(), dense_options(strategy));
    EXPECT_EQ(result.summary.overlapping, 0u);
    EXPECT_GT(result.summary.cycle_time, 1);
  }
}

TEST(DensePath, CountsTheTimeThatIsLost) {
  const Plan result = plan(circle_with_leads(), dense_options());
  EXPECT_EQ(result.summary.overlapping, kChords + 1);
  EXPECT_NEAR(result.summary.cycle_time,
              result.summary.path_length / kFeed + kStartAndEnd + result.summary.time_lost_at_corners, 1e-9);
  EXPECT_GT(result.summary.time_lost_at_corners, 0);
  EXPECT_LT(result.summary.time_lost_at_corners, 0.02);
}

TEST(DensePath, LosesNextToNothingAtEachCornerOfASmoothCurve) {
  const Plan result = plan(circle(), dense_options());
  for (std::size_t i = 60; i + 60 < result.corners.size(); ++i) {
    EXPECT_LT(std::abs(result.corners[i].time_lost), 0.05 * 0.001) << i;  // a chord takes 1 ms
  }
}

TEST(DensePath, StopsInTheMiddleAndStays) {
  Toolpath path = circle_with_leads();
  path.segments[300].dwell = 0.5;
  path.segments[300].stop = true;
  path.segments[301].tolerance = 0.02;  // and goes on with another tolerance
  const Plan result = plan(path, dense_options());
  EXPECT_EQ(result.corners[300].strategy, CornerStrategy::kExactStop);
  EXPECT_EQ(result.corners[300].dwell, 0.5);
  EXPECT_EQ(result.summary.exact_stops, 1u);
  EXPECT_EQ(result.summary.overlapping, kChords);
  EXPECT_EQ(result.summary.dwell_time, 0.5);
  EXPECT_NEAR(result.summary.cycle_time,
              result.summary.path_length / kFeed + kStartAndEnd + 0.5 + result.summary.time_lost_at_corners, 1e-9);
  EXPECT_GT(result.corners[300].time_lost, 0);
  const auto rests = [&](const Phase& phase) {
    return phase.duration == 0.5 && phase.start.position == path.segments[300].end &&
           phase.start.velocity == Vector::Zero() && phase.jerk == Vector::Zero();
  };
  bool rested = false;
  for (const Phase& phase : result.trajectory) rested |= rests(phase);
  EXPECT_TRUE(rested);
}

TEST(DensePath, StopsWhereThereIsNoTolerance) {
  Toolpath path = circle();
  path.segments[300].tolerance = path.segments[301].tolerance = 0;
  const Plan result = plan(path, dense_options());
  for (std::size_t i = 0; i < result.corners.size(); ++i) {
    const bool exact = i >= 299 && i <= 301;
    EXPECT_EQ(result.corners[i].strategy == CornerStrategy::kExactStop, exact) << i;
  }
  look_at(result, 300, 301,
          [&](const Phase&, const motion::State& state) { EXPECT_LT(distance_to_path(state.position, path), 1e-9); });
}

TEST(DensePath, KeepsTheFeedOfEachSegment) {
  Toolpath path = circle();
  for (std::size_t i = 300; i < kChords; ++i) path.segments[i].feed = 20;
  const Plan result = plan(path, dense_options());
  EXPECT_EQ(result.summary.overlapping, kChords - 1);
  expect_feed(result, 0, kChords, kFeed);
  expect_feed(result, 300, kChords, 20);
  EXPECT_LT(result.summary.cycle_time, 30 / 100. + 32.8 / 20. + 0.1);
}

TEST(DensePath, IsSlowOnlyWhereItsFeedIs) {
  Toolpath path = circle();
  for (std::size_t i = 200; i < 300; ++i) path.segments[i].feed = 20;
  const Plan result = plan(path, dense_options());
  EXPECT_EQ(result.summary.overlapping, kChords - 1);
  expect_feed(result, 200, 299, 20);
  EXPECT_LT(result.summary.cycle_time, 1.2);
}

TEST(DensePath, IsSmoothWhereAnAxisIsMuchWeaker) {
  PlanOptions options = dense_options();
  options.limits.acceleration.x() = kAcceleration / 4;
  const Plan result = plan(circle(), options);
  EXPECT_EQ(result.summary.overlapping, kChords - 1);
  expect_kept(result, options);
}

// Along a path that does not need it.
TEST(DensePath, IsAsFastWhateverAnAxisCanDoThatDoesNotMove) {
  Toolpath path;
  Vector end = Vector::Zero();
  double direction = 0;
  for (int i = 0; i < 4000; ++i) {
    direction += 0.1 * std::sin(0.013 * i);
    end += 0.3 * Vector(std::cos(direction), std::sin(direction), 0);
    path.segments.push_back({.end = end, .feed = 200, .tolerance = kTolerance});
  }
  PlanOptions options = dense_options();
  options.limits.axes = 3;
  const double alike = plan(path, options).summary.cycle_time;
  options.limits.acceleration.z() = 50;
  options.limits.jerk.z() = 1000;
  EXPECT_LT(plan(path, options).summary.cycle_time, 1.03 * alike);
}

// The steps of time become those of the least tolerance.
TEST(DensePath, CostsNoMemoryWhereOneToleranceIsFarLess) {
  const auto most_memory = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
  };
  Toolpath path;
  double angle = 0;
  for (int i = 0; i < 1500; ++i) {
    const bool exact = i == 800;
    angle += (exact ? 0.001 : 0.3) / 20;
    path.segments.push_back(
        {.end = {20 * std::sin(angle), 20 - 20 * std::cos(angle), 0}, .feed = kFeed, .tolerance = exact ? 1e-10 : 1});
  }
  const auto before = most_memory();
  plan(path, dense_options());
  // AddressSanitizer keeps up to 256 MB of what was given back.
  EXPECT_LT(most_memory() - before, kSanitizer ? 500'000 : 50'000) << "kB";
}

TEST(DensePath, KeepsTheToleranceOfEachSegment) {
  Toolpath path = circle();
  for (std::size_t i = 0; i < kChords; ++i) path.segments[i].tolerance = i % 2 == 0 ? 0.002 : 0.05;
  for (std::size_t i = 300; i < kChords; ++i) path.segments[i].tolerance = i / 50 % 2 == 0 ? 0.001 : 0.05;
  const Plan result = plan(path, dense_options());
  EXPECT_EQ(result.summary.overlapping, kChords - 1);
  for (std::size_t i = 0; i < result.corners.size(); ++i) {
    const double tolerance = std::min(path.segments[i].tolerance, path.segments[i + 1].tolerance);
    EXPECT_LE(result.corners[i].contour_error, tolerance) << i;
  }
  look_at(result, 0, kChords, [&](const Phase& phase, const motion::State& state) {
    double tolerance = INFINITY;
    for (std::size_t i = phase.segments.first; i <= phase.segments.last; ++i) {
      tolerance = std::min(tolerance, path.segments[i].tolerance);
    }
    EXPECT_LE(distance_to_path(state.position, path), tolerance * kRounding);
  });
}

TEST(DensePath, KeepsTheDistanceToCornersWhereThatIsTheTolerance) {
  const Plan result = plan(circle(), dense_options(CornerStrategy::kAuto, ToleranceKind::kCornerDistance));
  EXPECT_EQ(result.summary.overlapping, kChords - 1);
  EXPECT_LE(result.summary.cycle_time, 0.72);
  for (const Corner corner : result.corners) EXPECT_LE(corner.corner_distance, kTolerance);
}

TEST(DensePath, DoesNotMoveAnAxisThatIsNotThere) {
  const PlanOptions options = dense_options();
  ASSERT_EQ(options.limits.axes, 2u);
  const Plan result = plan(circle(), options);
  look_at(result, 0, kChords, [](const Phase& phase, const motion::State& state) {
    EXPECT_EQ(state.position.z(), 0);
    EXPECT_EQ(state.velocity.z(), 0);
    EXPECT_EQ(state.acceleration.z(), 0);
    EXPECT_EQ(phase.jerk.z(), 0);
  });
}

// A helix; over what the third axis can do.
class Helix : public testing::TestWithParam<double> {};

TEST_P(Helix, HoldsUnequalLimitsInThreeDimensions) {
  Toolpath path = circle();
  for (std::size_t i = 0; i < kChords; ++i) path.segments[i].end.z() = 0.02 * static_cast<double>(i);
  PlanOptions options = dense_options();
  options.limits = {3, Vector(80, 200, 30), Vector(1500, 4000, GetParam()), Vector(1e5, 8e4, 5e4)};
  const Plan result = plan(path, options);
  EXPECT_EQ(result.summary.overlapping, kChords - 1);
  expect_kept(result, options);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_LE(result.summary.max_velocity[axis], options.limits.velocity[axis] * kRounding);
  }
}

INSTANTIATE_TEST_SUITE_P(Accelerations, Helix, testing::Values(1000, 300));

// Over tolerances.
class Staircase : public testing::TestWithParam<double> {};

TEST_P(Staircase, IsFasterThanCornerByCorner) {
  Toolpath path;
  for (int i = 1; i <= 200; ++i) {
    const int right = (i + 1) / 2, up = i / 2;
    const Vector end(0.4 * right, 0.4 * up, 0);
    path.segments.push_back({.end = end, .feed = kFeed, .tolerance = GetParam()});
  }
  const Plan smooth = plan(path, dense_options()), each = plan(path, dense_options(CornerStrategy::kBlended));
  EXPECT_LT(smooth.summary.cycle_time, each.summary.cycle_time);
  double most = -INFINITY, least = INFINITY;
  for (std::size_t i = 20; i + 20 < smooth.corners.size(); ++i) {
    most = std::max(most, smooth.corners[i].time_lost);
    least = std::min(least, each.corners[i].time_lost);
  }
  EXPECT_LT(most, least);
}

INSTANTIATE_TEST_SUITE_P(Tolerances, Staircase, testing::Values(0.005, 0.01, 0.02, 0.05));

}  // namespace
}  // namespace kcs::planning
