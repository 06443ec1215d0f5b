#include "server/motion/progress.h"

#include <gtest/gtest.h>

#include <vector>

#include "server/motion/live_places.h"
#include "server/motion/place_sampler.h"
#include "server/motion/setpoint.h"

namespace kcs::motion {
namespace {

Path path_of(const std::vector<Vector>& points) {
  Path path(points.front());
  for (std::size_t i = 1; i < points.size(); ++i) path.add(points[i]);
  return path;
}

// From `from` to `to` at constant speed in `duration` seconds.
Phase straight(const Vector& from, const Vector& to, double start_time, double duration, const SegmentRange& segments) {
  return {.start_time = start_time,
          .duration = duration,
          .start = {.position = from, .velocity = (to - from) / duration},
          .segments = segments};
}

void expect_place(const Place& place, double way, std::uint32_t segment) {
  EXPECT_NEAR(place.way, way, 1e-12);
  EXPECT_EQ(place.segment, segment) << "at " << way;
}

TEST(Path, KnowsTheWayToEachSegment) {
  const Path path = path_of({{1, 0, 0}, {4, 4, 0}, {4, 4, 2}});
  EXPECT_EQ(path.segments(), 2U);
  EXPECT_EQ(path.way_to(1), 5);
  EXPECT_EQ(path.length(), 7);
  EXPECT_EQ(path.start_of(2), Vector(4, 4, 2));
  EXPECT_EQ(path.end().segment, 1U);
}

TEST(Path, ForgetsWhatIsNotNeeded) {
  Path path = path_of({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}});
  path.forget_before(1);
  path.add({7, 0, 0});
  EXPECT_EQ(path.segments(), 3U);
  EXPECT_EQ(path.way_to(1), 1);
  EXPECT_EQ(path.way_to(2), 3);
  EXPECT_EQ(path.length(), 7);
  EXPECT_EQ(path.bytes(), 3 * 32U + 12);
}

TEST(Path, KnowsTheLineOfEachSegmentAndCountsItsMemory) {
  Path path;
  path.add({1, 0, 0}, 4);
  path.add({2, 0, 0}, 5);
  path.add({3, 0, 0});
  EXPECT_EQ(path.line_of(0), 4U);
  EXPECT_EQ(path.line_of(1), 5U);
  EXPECT_EQ(path.line_of(2), 0U);
  EXPECT_EQ(path.bytes(), 4 * 32U + 2 * 12U);
  path.forget_before(2);
  EXPECT_EQ(path.line_of(2), 0U);
  EXPECT_EQ(path.bytes(), 2 * 32U + 12U);
}

TEST(Progress, CountsTheSegmentsOfAStraightLine) {
  const Path path = path_of({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {6, 0, 0}});
  Progress progress(path);
  progress.follow(straight({0, 0, 0}, {6, 0, 0}, 0, 6, {0, 2}));
  expect_place(progress.at(0), 0, 0);
  expect_place(progress.at(0.5), 0.5, 0);
  expect_place(progress.at(1), 1, 1);
  expect_place(progress.at(2.5), 2.5, 1);
  expect_place(progress.at(6), 6, 2);
}

TEST(Progress, LeapsOverWhatACornerCutsOff) {
  const Path path = path_of({{0, 0, 0}, {10, 0, 0}, {10, 10, 0}});
  Progress progress(path);
  progress.follow(straight({8, 0, 0}, {10, 2, 0}, 0, 2, {0, 1}));
  expect_place(progress.at(0.5), 8.5, 0);
  expect_place(progress.at(0.99), 8.99, 0);
  expect_place(progress.at(1.01), 11.01, 1);
  expect_place(progress.at(2), 12, 1);
}

TEST(Progress, TurnsWithTheToolWhereThePathComesBackOnItself) {
  const Path path = path_of({{0, 0, 0}, {10, 0, 0}, {0, 0, 0}});
  Progress progress(path);
  // To the corner and back in one phase of constant acceleration.
  Phase turn{.duration = 2, .start = {.position = {9, 0, 0}}, .segments = {0, 1}};
  turn.start.velocity = {2, 0, 0};
  turn.start.acceleration = {-2, 0, 0};
  progress.follow(turn);
  expect_place(progress.at(0.5), 9.75, 0);
  expect_place(progress.at(1.5), 10.25, 1);
  expect_place(progress.at(2), 11, 1);
}

TEST(Progress, StaysWhereTheToolRestsOrDriftsBack) {
  const Path path = path_of({{0, 0, 0}, {10, 0, 0}, {10, 10, 0}});
  Progress progress(path);
  progress.follow(straight({0, 0, 0}, {10, 0, 0}, 0, 1, {0, 0}));
  progress.follow({.start_time = 1, .duration = 5, .start = {.position = {10, 0, 0}}, .segments = {0, 0}});
  expect_place(progress.at(3), 10, 0);
  progress.follow(straight({10, 0, 0}, {10, -0.001, 0}, 6, 1, {0, 1}));
  EXPECT_NEAR(progress.at(1).way, 10, 1e-12);
  progress.follow(straight({10, -0.001, 0}, {10, 5, 0}, 7, 1, {1, 1}));
  expect_place(progress.at(1), 15, 1);
}

TEST(Progress, StaysWhileTheToolGoesBackForAMoment) {
  const Path path = path_of({{0, 0, 0}, {10, 0, 0}, {10, 10, 0}});
  Progress progress(path);
  Phase back{.duration = 3, .start = {.position = {2, 0, 0}}, .segments = {0, 1}};
  back.start.velocity = {-1, 0, 0};
  back.start.acceleration = {1, 0, 0};
  progress.follow(back);
  for (const double time : {0.0, 0.5, 1.0, 2.0}) expect_place(progress.at(time), 2, 0);
  expect_place(progress.at(3), 3.5, 0);
}

TEST(Progress, IsNotTakenInByTheWayBackBesideTheWayThere) {
  // A hairpin, and a tool between its sides, nearer to the way back.
  const Path path = path_of({{0, 0, 0}, {10, 0, 0}, {10, 1, 0}, {0, 1, 0}});
  Progress progress(path);
  progress.follow(straight({0, 0.6, 0}, {8, 0.6, 0}, 0, 8, {0, 2}));
  expect_place(progress.at(3), 3, 0);
}

TEST(Progress, OfAPathThatMovesNowhereIsNone) {
  const Path path;
  Progress progress(path);
  EXPECT_FALSE(progress.follow({.duration = 1}));
  expect_place(progress.at(0.5), 0, 0);
}

// A zigzag that is travelled at constant speed, each joint passed within a phase of its own.
struct Zigzag {
  Zigzag() {
    Vector at = Vector::Zero();
    for (int i = 1; i <= 500; ++i) {
      const Vector next(i, i % 2, 0);
      path.add(next);
      const auto segment = static_cast<std::uint32_t>(i - 1);
      add(straight(at, next - 0.1 * (next - Vector(i - 1, (i - 1) % 2, 0)), time, 0.9, {segment, segment}));
      at = trajectory_end();
      if (i == 500) break;
      const Vector after = next + 0.1 * (Vector(i + 1, (i + 1) % 2, 0) - next);
      add(straight(at, after, time, 0.2, {segment, segment + 1}));
      at = after;
    }
  }

  void add(const Phase& phase) {
    trajectory.append(phase);
    phases.push_back(phase);
    if (const auto milestone = progress.follow(phase)) milestones.push_back(*milestone);
    time = phase.end_time();
  }
  Vector trajectory_end() const { return phases.back().at(phases.back().duration).position; }

  Path path;
  double time = 0;
  Trajectory trajectory;
  std::vector<Phase> phases;
  std::vector<Milestone> milestones;
  Progress progress{path};
};

TEST(PlaceSampler, GivesTheSamePlaceWhateverWasAskedBefore) {
  const Zigzag zigzag;
  ASSERT_GT(zigzag.milestones.size(), 10U);
  PlaceSampler forward(zigzag.trajectory, zigzag.path, zigzag.milestones, 0.01);
  PlaceSampler jumping(zigzag.trajectory, zigzag.path, zigzag.milestones, 0.01);
  const std::uint64_t count = setpoint_count(zigzag.trajectory.duration(), 0.01);
  std::vector<Place> expected;
  for (std::uint64_t i = 0; i < count; ++i) expected.push_back(forward.at(i));
  for (std::uint64_t i = 0, index = 0; i < count; ++i) {
    index = (index + 12'347) % count;
    const Place place = jumping.at(index);
    ASSERT_EQ(place.way, expected[index].way) << index;
    ASSERT_EQ(place.segment, expected[index].segment) << index;
  }
  EXPECT_EQ(expected.front().way, 0);
  EXPECT_EQ(expected.back().way, zigzag.path.length());
  EXPECT_EQ(expected.back().segment, 499U);
}

TEST(LivePlaces, AreThoseOfTheWholeTrajectory) {
  const Zigzag zigzag;
  for (const double period : {0.01, 1.7, 300.0}) {
    PlaceSampler stored(zigzag.trajectory, zigzag.path, zigzag.milestones, period);
    LivePlaces live(Vector::Zero(), period);
    std::uint32_t known = 0;
    std::uint64_t index = 0;
    for (const Phase& phase : zigzag.phases) {
      for (; known <= phase.segments.last; ++known) live.add(zigzag.path.start_of(known + 1), known / 3);
      live.add(phase);
      for (; setpoint_time(index, period) < phase.end_time(); ++index) {
        const Place expected = stored.at(index), place = live.next();
        ASSERT_EQ(place.way, expected.way) << index;
        ASSERT_EQ(place.segment, expected.segment) << index;
        ASSERT_EQ(live.path().line_of(place.segment), place.segment / 3) << index;
      }
    }
    EXPECT_EQ(live.end().way, zigzag.path.length());
  }
}

}  // namespace
}  // namespace kcs::motion
