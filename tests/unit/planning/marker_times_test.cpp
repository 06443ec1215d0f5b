// When what a path switches is due.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "server/planning/planner.h"
#include "tests/unit/planning/paths.h"

namespace kcs::planning {
namespace {

constexpr double kFeed = 100, kTolerance = 0.01;

PlanOptions options(CornerStrategy strategy = CornerStrategy::kAuto) {
  return options_for(2000, 1e5, ToleranceKind::kContourError, strategy);
}

Segment to(double x, double y, Segment rest = {}) {
  rest.end = {x, y, 0};
  rest.feed = kFeed;
  rest.tolerance = kTolerance;
  return rest;
}

Toolpath path_of(std::vector<Segment> segments) {
  Toolpath path;
  path.segments = std::move(segments);
  return path;
}

motion::State at(const Plan& plan, double time) {
  auto phase = plan.trajectory.begin();
  phase.seek(time);
  return phase->at(time - phase->start_time);
}

constexpr Marker kFlood{.kind = MarkerKind::kFloodOn}, kOff{.kind = MarkerKind::kCoolantOff};

TEST(MarkerTimes, OnALineIsWhenTheToolPasses) {
  const Plan made = plan(path_of({to(10, 0, {.marker = kFlood}), to(30, 0)}), options());
  ASSERT_EQ(made.markers.size(), 1u);
  EXPECT_EQ(made.markers[0].marker, kFlood);
  EXPECT_NEAR(at(made, made.markers[0].time).position.x(), 10, 1e-6);
  EXPECT_EQ(made.summary.markers, 1u);
  EXPECT_EQ(made.summary.exact_stops, 0u);
}

TEST(MarkerTimes, AtACornerThatIsCutIsItsMiddle) {
  for (const CornerStrategy strategy : {CornerStrategy::kInterrupted, CornerStrategy::kBlended}) {
    const Plan made = plan(path_of({to(20, 0, {.marker = kFlood}), to(20, 20)}), options(strategy));
    ASSERT_EQ(made.markers.size(), 1u);
    const Vector there = at(made, made.markers[0].time).position;
    EXPECT_NEAR(20 - there.x(), there.y(), 1e-6) << "as far before the corner as beyond it";
    EXPECT_GT(there.y(), 0);
  }
}

TEST(MarkerTimes, BehindASharpCornerIsNotBeforeIt) {
  for (const double behind : {0.02, 0.05, 0.1, 0.5}) {
    const Vector place(10 - 0.6 * behind, 0.8 * behind, 0);
    const Plan made = plan(path_of({to(10, 0), to(place.x(), place.y(), {.marker = kFlood}), to(4, 8)}), options());
    ASSERT_EQ(made.markers.size(), 1u);
    const Vector there = at(made, made.markers[0].time).position;
    EXPECT_LT((there - place).norm(), 4 * kTolerance) << behind;
  }
}

TEST(MarkerTimes, WhereThePathTurnsBackIsItsFarthestPlace) {
  const Plan made = plan(path_of({to(20, 0, {.marker = kFlood}), to(0, 0)}), options());
  ASSERT_EQ(made.markers.size(), 1u);
  EXPECT_NEAR(at(made, made.markers[0].time).position.x(), 20, 4 * kTolerance);
  EXPECT_NEAR(made.markers[0].time, made.summary.cycle_time / 2, 1e-6);
}

TEST(MarkerTimes, OnADenseCurveIsWhereTheToolIsNear) {
  Toolpath path;
  std::vector<Vector> places;
  for (int i = 1; i <= 2000; ++i) {
    const double angle = 0.01 * i;
    Segment segment = to(20 * std::sin(angle), 20 - 20 * std::cos(angle));
    if (i % 100 == 0) {
      segment.marker = kFlood;
      places.push_back(segment.end);
    }
    path.segments.push_back(segment);
  }
  const Plan made = plan(path, options());
  ASSERT_EQ(made.markers.size(), places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_LE((at(made, made.markers[i].time).position - places[i]).norm(), 2 * kTolerance) << i;
  }
}

TEST(MarkerTimes, WhereTheToolRestsFollowWhatItDoesThere) {
  const Plan made = plan(path_of({to(20, 0, {.dwell = 2, .stop = true, .marker = kFlood}), to(20, 0, {.marker = kOff}),
                                  to(20, 0, {.dwell = 1, .stop = true}), to(20, 20)}),
                         options());
  ASSERT_EQ(made.markers.size(), 6u);
  const double arrival = made.markers[0].time;
  EXPECT_EQ(made.markers[0].marker, kFlood);
  EXPECT_NEAR(arrival, (made.summary.cycle_time - 3) / 2, 1e-9);
  const struct {
    MarkerKind kind;
    double after;
  } expected[] = {{MarkerKind::kFloodOn, 0},    {MarkerKind::kDwellBegins, 0}, {MarkerKind::kDwellEnds, 2},
                  {MarkerKind::kCoolantOff, 2}, {MarkerKind::kDwellBegins, 2}, {MarkerKind::kDwellEnds, 3}};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(made.markers[i].marker.kind, expected[i].kind) << i;
    EXPECT_NEAR(made.markers[i].time - arrival, expected[i].after, 1e-9) << i;
  }
}

TEST(MarkerTimes, WithoutADwellAreThoseOfTheStop) {
  const Plan made = plan(path_of({to(20, 0, {.stop = true, .marker = kFlood}), to(40, 0)}), options());
  ASSERT_EQ(made.markers.size(), 1u);
  EXPECT_NEAR(made.markers[0].time, made.summary.cycle_time / 2, 1e-9);
}

TEST(MarkerTimes, AtBothEndsOfThePathAreThoseOfTheMotion) {
  const Plan made = plan(path_of({to(0, 0, {.marker = kFlood}), to(20, 0), to(20, 0, {.marker = kOff})}), options());
  ASSERT_EQ(made.markers.size(), 2u);
  EXPECT_EQ(made.markers[0].time, 0);
  EXPECT_NEAR(made.markers[1].time, made.summary.cycle_time, 1e-4);
  EXPECT_LE(made.markers[1].time, made.summary.cycle_time);
}

TEST(MarkerTimes, OfAPathThatMovesNowhereAreItsDwells) {
  const Plan made = plan(path_of({to(0, 0, {.dwell = 1, .stop = true, .marker = kFlood})}), options());
  ASSERT_EQ(made.markers.size(), 3u);
  EXPECT_EQ(made.markers[0].time, 0);
  EXPECT_EQ(made.markers[2].time, 1);
}

}  // namespace
}  // namespace kcs::planning
