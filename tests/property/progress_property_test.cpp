// The places on the path that belong to the setpoints: of random plans, stored and live.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "server/motion/live_places.h"
#include "server/motion/live_sampler.h"
#include "server/motion/place_sampler.h"
#include "server/motion/sampler.h"
#include "server/planning/live_planner.h"
#include "server/planning/plan_path.h"
#include "tests/property/dense_case.h"
#include "tests/property/long_case.h"
#include "tests/property/random_case.h"

namespace kcs::test {
namespace {

using motion::Place;
using motion::Vector;
using planning::Plan;

// How far the tool may be from its place, in tolerances, where the path turns to and fro within them; and how many
// setpoints may be farther from it than the tolerance.
constexpr double kMostTolerances = 6, kMostBeyond = 1e-3;

std::vector<double> tolerances_of(const planning::Toolpath& path) {
  std::vector<double> result;
  for (std::size_t i = 0; i < path.segments.size(); ++i) {
    const bool moves = (path.segments[i].end - path.start_of(i)).norm() >= planning::kNoLength;
    if (moves) result.push_back(path.segments[i].tolerance);
  }
  return result;
}

// What rounding makes of a distance on this path, mm.
double rounding_of(const planning::Toolpath& path) {
  double largest = 0;
  for (const planning::Segment& segment : path.segments) largest = std::max(largest, segment.end.cwiseAbs().maxCoeff());
  return 1e-9 + 1e-14 * largest;
}

// Some setpoints a phase.
double period_of(const Plan& plan) {
  return std::max(1e-5, plan.trajectory.duration() / (7.3 * static_cast<double>(plan.trajectory.size() + 1)));
}

class Places {
 public:
  Places(const Case& problem, const Plan& plan)
      : plan_(plan),
        tolerances_(tolerances_of(problem.path)),
        rounding_(rounding_of(problem.path)),
        period_(period_of(plan)) {}

  void judge() {
    motion::Sampler setpoints(plan_.trajectory, period_);
    motion::PlaceSampler places = sampler();
    auto phase = plan_.trajectory.begin();
    Place before;
    for (std::uint64_t i = 0; i < setpoints.count(); ++i, ++count) {
      const Place place = places.at(i);
      ASSERT_GE(place.way, before.way - rounding_) << "setpoint " << i;
      ASSERT_GE(place.segment, before.segment) << "setpoint " << i;
      before = place;
      if (tolerances_.empty()) continue;
      phase.seek(static_cast<double>(i) * period_);
      is_near(setpoints.at(i).state.position, place, phase == plan_.trajectory.end() ? last() : phase->segments);
    }
    EXPECT_EQ(before.way, plan_.summary.path_length);
    EXPECT_EQ(before.segment + 1, std::max<std::size_t>(1, plan_.summary.segments));
    for (std::uint64_t i = 0; i < setpoints.count(); i += 1 + setpoints.count() / 50) {
      const Place alone = sampler().at(i), again = places.at(i);
      ASSERT_EQ(alone.way, again.way) << "setpoint " << i;
      ASSERT_EQ(alone.segment, again.segment) << "setpoint " << i;
    }
  }

  motion::PlaceSampler sampler() const { return {plan_.trajectory, plan_.path, plan_.milestones, period_}; }
  double period() const { return period_; }

  std::uint64_t count = 0, beyond = 0;

 private:
  motion::SegmentRange last() const { return {plan_.path.segments() - 1, plan_.path.segments() - 1}; }

  // The tool follows `segments` then.
  void is_near(const Vector& tool, const Place& place, const motion::SegmentRange& segments) {
    const Vector &from = plan_.path.start_of(place.segment), &to = plan_.path.start_of(place.segment + 1);
    const double along = place.way - plan_.path.way_to(place.segment), length = (to - from).norm();
    ASSERT_GE(along, -rounding_);
    ASSERT_LE(along, length + rounding_);
    double tolerance = 0;
    for (std::uint32_t i = segments.first; i <= segments.last; ++i) tolerance = std::max(tolerance, tolerances_[i]);
    const double distance = (from + along / length * (to - from) - tool).norm();
    ASSERT_LE(distance, kMostTolerances * tolerance + 4 * rounding_) << "at " << place.way << " mm";
    if (distance > tolerance * (1 + 1e-6) + 4 * rounding_) ++beyond;
  }

  const Plan& plan_;
  std::vector<double> tolerances_;
  double rounding_, period_;
};

// Plans live, and compares each place with the one of the stored plan.
class LiveComparison : public planning::PlanReceiver {
 public:
  LiveComparison(const Case& problem, const Places& stored)
      : setpoints_(stored.period()), places_(problem.path.start, stored.period()), stored_(stored.sampler()) {
    planning::LivePlanner planner(problem.path, problem.options, *this);
    for (const planning::Segment& segment : problem.path.segments) planner.add(segment);
    planner.finish();
    setpoints_.finish(planner.end_state());
    compare();
  }

  void take(const planning::Segment& segment) override { places_.add(segment.end); }
  void take(const motion::Phase& phase) override {
    setpoints_.add(phase);
    places_.add(phase);
    compare();
  }
  void take(const planning::Corner& /*corner*/) override {}
  void take(const planning::MarkerAt& /*marker*/) override {}

 private:
  void compare() {
    while (setpoints_.next()) {
      const Place place = setpoints_.ended() ? places_.end() : places_.next(), expected = stored_.at(index_++);
      ASSERT_EQ(place.way, expected.way) << "setpoint " << index_ - 1;
      ASSERT_EQ(place.segment, expected.segment) << "setpoint " << index_ - 1;
    }
  }

  motion::LiveSampler setpoints_;
  motion::LivePlaces places_;
  motion::PlaceSampler stored_;
  std::uint64_t index_ = 0;
};

void follow_the_path(Case (*make)(std::uint64_t seed), std::uint64_t count) {
  std::uint64_t setpoints = 0, beyond = 0;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const Case problem = make(seed);
    const Plan plan = planning::plan(problem.path, problem.options);
    Places places(problem, plan);
    places.judge();
    const LiveComparison compared(problem, places);
    if (testing::Test::HasFailure()) FAIL() << describe(problem);
    setpoints += places.count;
    beyond += places.beyond;
  }
  EXPECT_LE(static_cast<double>(beyond), kMostBeyond * static_cast<double>(setpoints));
}

TEST(Progress, NeverFallsOnRandomPaths) { follow_the_path(random_case, 2'000); }
TEST(Progress, NeverFallsOnDensePaths) { follow_the_path(dense_case, 100); }
TEST(Progress, NeverFallsOnLongPaths) { follow_the_path(long_case, 20); }

}  // namespace
}  // namespace kcs::test
