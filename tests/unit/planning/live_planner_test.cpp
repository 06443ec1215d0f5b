// Paths that are planned while they arrive, and paths that begin or end in motion.

#include "server/planning/live_planner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "server/planning/invalid_input.h"
#include "tests/property/random.h"
#include "tests/unit/planning/paths.h"

namespace kcs::planning {
namespace {

using motion::Phase;
using testing::HasSubstr;

constexpr double kFeed = 100, kTolerance = 0.01;

PlanOptions options() { return options_for(2000, 1e5, ToleranceKind::kContourError, CornerStrategy::kAuto); }

class Received : public PlanReceiver {
 public:
  void take(const Segment& segment) override { ends.push_back(segment.end); }
  void take(const Phase& phase) override { phases.push_back(phase); }
  void take(const Corner& corner) override { corners.push_back(corner); }
  void take(const MarkerAt& /*marker*/) override {}

  std::vector<Vector> ends;
  std::vector<Phase> phases;
  std::vector<Corner> corners;
};

// Segment i of a spiral whose turns are a millimetre apart.
Segment of_spiral(std::size_t i) {
  const double angle = std::sqrt(2 * 0.2 * static_cast<double>(i) * 6.3);
  const double radius = angle / 6.3;
  return {.end = Vector(radius * std::cos(angle), radius * std::sin(angle), 0), .feed = kFeed, .tolerance = kTolerance};
}

TEST(LivePlanner, PassesMotionOnAFewHundredSegmentsAfterThePath) {
  Received received;
  LivePlanner planner({}, options(), received);
  constexpr std::size_t kSegments = 6000, kFarthest = 1000;
  for (std::size_t i = 1; i <= kSegments; ++i) {
    planner.add(of_spiral(i));
    if (i < kFarthest) continue;
    ASSERT_FALSE(received.phases.empty());
    ASSERT_LT(i - received.phases.back().segments.last, kFarthest);
    ASSERT_LT(i - received.corners.back().segment, kFarthest);
  }
  const Summary summary = planner.finish();
  EXPECT_EQ(received.phases.back().end_time(), summary.cycle_time);
  EXPECT_EQ(summary.segments, kSegments);
  EXPECT_EQ(received.corners.size(), kSegments - 1);
  EXPECT_GT(summary.overlapping, kSegments / 2);
}

TEST(LivePlanner, SettlesTheSameWhateverComesLater) {
  Received one, other;
  LivePlanner first({}, options(), one), second({}, options(), other);
  for (std::size_t i = 1; i <= 3000; ++i) {
    first.add(of_spiral(i));
    second.add(of_spiral(i));
  }
  const std::size_t settled = one.phases.size();
  ASSERT_GT(settled, 1000u);
  first.add({.end = Vector(100, 0, 0), .feed = 1, .tolerance = kTolerance});
  first.finish();
  for (std::size_t i = 3001; i <= 4000; ++i) second.add(of_spiral(i));
  second.finish();
  for (std::size_t i = 0; i < settled; ++i) {
    ASSERT_EQ(one.phases[i].start.position, other.phases[i].start.position) << i;
    ASSERT_EQ(one.phases[i].jerk, other.phases[i].jerk) << i;
  }
}

// Legs hardly longer than the tolerance, most of them at sharp corners: smooth motions are hard to find.
Toolpath tangled(std::uint64_t seed) {
  test::Random random(seed);
  Toolpath path;
  Vector end = Vector::Zero();
  double angle = 0;
  for (int i = 0; i < 1000; ++i) {
    angle += random.chance(0.6) ? random.uniform(-0.2, 0.2) : random.uniform(-2, 2);
    end += random.uniform(0.02, 0.11) * Vector(std::cos(angle), std::sin(angle), 0);
    path.segments.push_back({.end = end, .feed = kFeed, .tolerance = 0.04});
  }
  return path;
}

class TangledPath : public testing::TestWithParam<std::uint64_t> {};

// One by one its corners take up to 12 s.
TEST_P(TangledPath, IsTravelledSmoothlyWhereAMotionIsFoundForANearerHorizonOnly) {
  const Toolpath path = tangled(GetParam());
  const Summary summary = plan(path, options()).summary;
  EXPECT_GT(summary.overlapping, path.segments.size() * 9 / 10);
  EXPECT_LT(summary.cycle_time, 5);
}

// The first ones need horizons much nearer than half, the others one that sees all that the verifier was shown.
INSTANTIATE_TEST_SUITE_P(Seeds, TangledPath, testing::Values(2, 34, 39, 5, 23, 32));

TEST(LivePlanner, TakesALineOfManySegmentsAsOne) {
  Toolpath many;
  constexpr std::size_t kSegments = 25'000;
  for (std::size_t i = 1; i <= kSegments; ++i) {
    many.segments.push_back(
        {.end = Vector(0.0078125 * static_cast<double>(i), 0, 0), .feed = kFeed, .tolerance = kTolerance});
  }
  Toolpath one;
  one.segments.push_back(many.segments.back());
  const Plan of_many = plan(many, options()), of_one = plan(one, options());
  EXPECT_EQ(of_many.summary.segments, kSegments);
  EXPECT_NEAR(of_many.summary.cycle_time, of_one.summary.cycle_time, 1e-9);
}

TEST(LivePlanner, RefusesABadSegmentByItsNumber) {
  Received received;
  LivePlanner planner({}, options(), received);
  planner.add(of_spiral(1));
  try {
    planner.add({.end = Vector(NAN, 0, 0), .feed = kFeed});
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("path, segment 1, x"));
  }
}

// A zig-zag of 20 mm legs.
Toolpath zigzag() { return path_through({{20, 0, 0}, {3, 10, 0}, {22, 16, 0}, {4, 25, 0}, {23, 30, 0}}, kFeed, 0.05); }

TEST(PathInMotion, SavesWhatStartingAndStoppingCosts) {
  Toolpath path = path_through({{100, 0, 0}, {100, 100, 0}}, kFeed, 0.05);
  const double at_rest = plan(path, options()).summary.cycle_time;
  path.start_speed = path.end_speed = kFeed;
  const Plan result = plan(path, options());
  EXPECT_EQ(result.trajectory.begin()->start.velocity, Vector(kFeed, 0, 0));
  EXPECT_DOUBLE_EQ(result.trajectory.final_state().velocity.norm(), kFeed);
  // From rest to the feed takes V/2A + A/2J longer than at the feed; the same at the end.
  EXPECT_NEAR(result.summary.cycle_time, at_rest - (kFeed / 2000 + 2000 / 1e5), 1e-9);
}

TEST(PathInMotion, GoesOnWithTheAccelerationItStartsWith) {
  for (const double acceleration : {1500.0, -1500.0}) {
    Toolpath path = zigzag();
    path.start_speed = 50;
    path.start_acceleration = acceleration;
    const Plan result = plan(path, options());
    EXPECT_EQ(result.trajectory.begin()->start.acceleration, Vector(acceleration, 0, 0));
  }
}

TEST(PathInMotion, CanBeCutAndPlannedInParts) {
  Toolpath whole = path_through({{50, 0, 0}, {100, 0, 0}, {100, 50, 0}}, kFeed, 0.05);
  Toolpath first = path_through({{50, 0, 0}}, kFeed, 0.05),
           second = path_through({{100, 0, 0}, {100, 50, 0}}, kFeed, 0.05);
  first.end_speed = second.start_speed = kFeed;
  second.start = Vector(50, 0, 0);
  const Plan before = plan(first, options()), after = plan(second, options());
  EXPECT_EQ(before.trajectory.final_state().position, after.trajectory.begin()->start.position);
  EXPECT_EQ(before.trajectory.final_state().velocity, after.trajectory.begin()->start.velocity);
  EXPECT_NEAR(before.summary.cycle_time + after.summary.cycle_time, plan(whole, options()).summary.cycle_time, 1e-9);
}

struct BadEnds {
  const char* name;
  PathEnds ends;
  const char* message;
};

class PathThatCannotBegin : public testing::TestWithParam<BadEnds> {};

TEST_P(PathThatCannotBegin, SaysWhy) {
  Toolpath path = path_through({{2, 0, 0}, {2, 2, 0}}, kFeed, 0.01);
  static_cast<PathEnds&>(path) = GetParam().ends;
  try {
    plan(path, options());
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr(GetParam().message));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Ends, PathThatCannotBegin,
    testing::Values(
        BadEnds{"TooFastForTheFeed", {.start_speed = 101}, "path, start_speed: is 101 mm/s"},
        BadEnds{"TooFastForTheFeedButBraking",
                {.start_speed = 101, .start_acceleration = -1000},
                "path, start_speed: is 101 mm/s"},
        BadEnds{"TooFastToBrake", {.start_speed = 99}, "start more slowly"},
        BadEnds{"BeyondTheAxes", {.start_acceleration = 3000}, "path, start_acceleration: is 3000 mm/s²"},
        BadEnds{"Backwards", {.start_speed = 1, .start_acceleration = -2000}, "path, start_speed: is 1 mm/s"},
        BadEnds{"TooShortToGetFast", {.end_speed = 99}, "path, end_speed: is 99 mm/s, but the path is too short"},
        BadEnds{"EndFasterThanTheFeed", {.end_speed = 101}, "may be no faster than 100"},
        BadEnds{"Nan", {.start_speed = NAN}, "path, start_speed: is nan"}),
    [](const auto& test) { return test.param.name; });

// A path may begin and end anywhere on a curve, on legs shorter than what the tool travels in a step of time.
TEST(PathInMotion, BeginsAndEndsInTheMiddleOfADenseCurve) {
  for (const double length : {0.05, 0.1, 0.3, 1.0}) {
    for (const double speed : {10.0, 30.0, 50.0}) {
      Toolpath path = turning_legs(static_cast<int>(60 / length), length, 180 / std::numbers::pi * length / 10);
      for (Segment& segment : path.segments) segment.tolerance = 0.01;
      const double at_rest = plan(path, options()).summary.cycle_time;
      path.start_speed = path.end_speed = speed;
      const Plan result = plan(path, options());
      EXPECT_EQ(result.trajectory.begin()->start.position, Vector(0, 0, 0));
      EXPECT_NEAR(result.trajectory.begin()->start.velocity.norm(), speed, 1e-9);
      EXPECT_DOUBLE_EQ(result.trajectory.final_state().velocity.norm(), speed);
      EXPECT_LT(result.summary.cycle_time, at_rest) << length << " mm, " << speed << " mm/s";
    }
  }
}

TEST(PathInMotion, BeginsAShortLegOfACurveWhileItGetsFaster) {
  for (const double acceleration : {-1000.0, 500.0, 1500.0}) {
    Toolpath path = turning_legs(200, 0.3, 2);
    path.start_speed = 30;
    path.start_acceleration = acceleration;
    const Plan result = plan(path, options());
    EXPECT_NEAR(result.trajectory.begin()->start.acceleration.x(), acceleration, 1e-6);
    EXPECT_NEAR(result.trajectory.begin()->start.velocity.x(), 30, 1e-9);
    EXPECT_LT(result.summary.cycle_time, 0.75) << acceleration;
  }
}

// Whoever goes on from there counts on it.
TEST(PathInMotion, EndsAsFastAsAskedForOnAShortLegOfACurve) {
  for (const double speed : {20.0, 24.0, 30.0, 40.0, 47.0}) {
    Toolpath path = turning_legs(30, 1, 5);
    const std::size_t last = path.segments.size() - 1;
    path.segments[last].end = path.start_of(last) + 0.3 * (path.segments[last].end - path.start_of(last));
    const double at_rest = plan(path, options()).summary.cycle_time;
    path.end_speed = speed;
    const Plan result = plan(path, options());
    EXPECT_DOUBLE_EQ(result.trajectory.final_state().velocity.norm(), speed);
    EXPECT_LT(result.summary.cycle_time, at_rest) << speed;
  }
}

TEST(PathInMotion, ExcludesRestsAtItsEnds) {
  Toolpath path = zigzag();
  path.end_speed = 10;
  path.segments.back().stop = true;
  EXPECT_THROW(plan(path, options()), InvalidInput);
  path = zigzag();
  path.start_speed = 10;
  path.segments.insert(path.segments.begin(), {.end = path.start, .feed = kFeed, .dwell = 1});
  EXPECT_THROW(plan(path, options()), InvalidInput);
  path.segments.front() = {.end = path.start, .feed = kFeed, .stop = true};
  EXPECT_THROW(plan(path, options()), InvalidInput);
  path = path_through({{0, 0, 0}}, kFeed, 0.01);
  path.start_speed = 10;
  EXPECT_THROW(plan(path, options()), InvalidInput);
}

}  // namespace
}  // namespace kcs::planning
