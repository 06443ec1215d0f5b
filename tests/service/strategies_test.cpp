// How the corners of a plan are taken, as the service says it.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/service/test_server.h"

namespace kcs::service::test {
namespace {

// A circle of 10 mm radius in 628 chords at 100 mm/s, from rest to rest: 0.628 s at the feed.
std::string dense_circle() {
  std::ifstream file(KCS_SOURCE "/tests/data/circle.nc");
  return {std::istreambuf_iterator<char>(file), {}};
}

// Of the planar table in deploy/machines/tajima-sencer-2016.toml.
v1::PlanOptions planar_table() {
  v1::PlanOptions options;
  options.mutable_machine()->set_axes(2);
  options.mutable_machine()->mutable_velocity_mm_s()->Resize(2, 500);
  options.mutable_machine()->mutable_acceleration_mm_s2()->Resize(2, 2000);
  options.mutable_machine()->mutable_jerk_mm_s3()->Resize(2, 1e5);
  options.set_tolerance_mm(0.01);
  return options;
}

class Strategies : public ::testing::Test {
 protected:
  v1::Plan create(const v1::PlanOptions& options, const v1::CreatePlanRequest& path) {
    const auto plan = server_.create({request(options), path});
    EXPECT_TRUE(plan.status.ok()) << plan.status.error_message();
    return plan.message;
  }

  TestServer server_;
};

TEST_F(Strategies, BlendedIsTakenWhereItIsAskedForAndBeatsThePapersTwo) {
  const auto take = [this](v1::CornerStrategy strategy) {
    v1::PlanOptions asked = options();
    asked.set_strategy(strategy);
    return create(asked, request(right_angle()));
  };
  const v1::Plan blended = take(v1::CORNER_STRATEGY_BLENDED);
  EXPECT_EQ(blended.options().strategy(), v1::CORNER_STRATEGY_BLENDED);
  EXPECT_EQ(blended.summary().blended_count(), 1U);
  const auto corners = server_.corners(blended.name()).message;
  ASSERT_EQ(corners.size(), 1U);
  EXPECT_EQ(corners[0].strategy(), v1::CORNER_STRATEGY_BLENDED);
  for (const auto paper : {v1::CORNER_STRATEGY_INTERRUPTED, v1::CORNER_STRATEGY_UNINTERRUPTED}) {
    const v1::Plan other = take(paper);
    EXPECT_NE(other.name(), blended.name());
    EXPECT_LT(blended.summary().cycle_time_s(), other.summary().cycle_time_s());
  }
}

TEST_F(Strategies, DenseCircleIsPassedInOneMotionAtNearlyItsFeed) {
  const v1::Plan plan = create(planar_table(), gcode(dense_circle()));
  const v1::PlanSummary& summary = plan.summary();
  EXPECT_EQ(summary.segment_count(), 628U);
  EXPECT_GT(summary.overlapping_count(), 0U);
  EXPECT_LT(summary.cycle_time_s(), 0.75);
  EXPECT_LE(summary.max_contour_error_mm(), 0.01);
  for (int axis = 0; axis < 2; ++axis) {
    EXPECT_LE(summary.max_acceleration_mm_s2(axis), 2000 * (1 + 1e-9));
    EXPECT_LE(summary.max_jerk_mm_s3(axis), 1e5 * (1 + 1e-9));
  }
}

TEST_F(Strategies, CountsAreThoseOfTheCorners) {
  const v1::Plan plan = create(planar_table(), gcode(dense_circle()));
  const auto corners = server_.corners(plan.name()).message;
  const auto count = [&corners](v1::CornerStrategy strategy) {
    return static_cast<std::uint64_t>(
        std::count_if(corners.begin(), corners.end(),
                      [strategy](const v1::Corner& corner) { return corner.strategy() == strategy; }));
  };
  const v1::PlanSummary& summary = plan.summary();
  EXPECT_EQ(summary.corner_count(), corners.size());
  EXPECT_EQ(summary.interrupted_count(), count(v1::CORNER_STRATEGY_INTERRUPTED));
  EXPECT_EQ(summary.uninterrupted_count(), count(v1::CORNER_STRATEGY_UNINTERRUPTED));
  EXPECT_EQ(summary.exact_stop_count(), count(v1::CORNER_STRATEGY_EXACT_STOP));
  EXPECT_EQ(summary.blended_count(), count(v1::CORNER_STRATEGY_BLENDED));
  EXPECT_EQ(summary.overlapping_count(), count(v1::CORNER_STRATEGY_OVERLAPPING));
}

TEST_F(Strategies, OverlappingCornersSayWhatTheyAreLike) {
  const v1::Plan plan = create(planar_table(), gcode(dense_circle()));
  const double feed = plan.summary().max_feed_mm_s();
  double lost = 0;
  std::uint64_t segment = 0;
  for (const v1::Corner& corner : server_.corners(plan.name()).message) {
    lost += corner.time_lost_s();
    EXPECT_EQ(corner.segment(), segment++);
    if (corner.strategy() != v1::CORNER_STRATEGY_OVERLAPPING) continue;
    EXPECT_EQ(corner.line(), corner.segment() + 3) << "the program moves from its third line on";
    EXPECT_GT(corner.speed_mm_s(), 0);
    EXPECT_LE(corner.speed_mm_s(), feed);
    EXPECT_EQ(corner.boundary_acceleration_mm_s2(), 0);
    EXPECT_GT(corner.corner_distance_mm(), 0);
    EXPECT_EQ(corner.deviation_mm(), corner.contour_error_mm());
    EXPECT_LE(corner.deviation_mm(), 0.01);
    EXPECT_EQ(corner.dwell_s(), 0);
  }
  EXPECT_NEAR(plan.summary().time_lost_at_corners_s(), lost, 1e-9);
}

}  // namespace
}  // namespace kcs::service::test
