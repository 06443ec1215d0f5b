// Paths that begin where the tool is moving already, and end where it goes on moving.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/service/test_server.h"

namespace kcs::service::test {
namespace {

class InMotion : public ::testing::Test {
 protected:
  // Position, velocity and acceleration in X at every millisecond.
  struct Motion {
    v1::Plan plan;
    std::vector<double> position, velocity, acceleration;
  };

  Motion motion(const v1::PlanOptions& asked, const v1::PathChunk& path) {
    const auto plan = server_.create({request(asked), request(path)});
    EXPECT_TRUE(plan.status.ok()) << plan.status.error_message();
    auto wanted = setpoints(plan.message.name(), 0.001);
    wanted.add_channels(v1::CHANNEL_VELOCITY);
    wanted.add_channels(v1::CHANNEL_ACCELERATION);
    const auto batches = server_.stream(wanted).message;
    return {plan.message, column(batches, 0), column(batches, 0, &v1::SetpointBatch::velocity_mm_s),
            column(batches, 0, &v1::SetpointBatch::acceleration_mm_s2)};
  }

  grpc::Status create(const v1::PlanOptions& options) {
    return server_.create({request(options), request(path({0, 0, 10, 0, 10, 10}))}).status;
  }

  TestServer server_;
};

TEST_F(InMotion, StartsAndEndsAsAsked) {
  v1::PlanOptions asked = options();
  asked.set_start_speed_mm_s(60);
  asked.set_start_acceleration_mm_s2(-400);
  asked.set_end_speed_mm_s(25);
  const Motion moving = motion(asked, path({0, 0, 10, 0, 20, 1, 50, 1}));
  EXPECT_EQ(moving.velocity.front(), 60);
  EXPECT_EQ(moving.acceleration.front(), -400);
  EXPECT_EQ(moving.position.back(), 50);
  EXPECT_EQ(moving.velocity.back(), 25);
  EXPECT_EQ(moving.acceleration.back(), 0);
  EXPECT_EQ(moving.plan.options().start_speed_mm_s(), 60);
  EXPECT_EQ(moving.plan.options().start_acceleration_mm_s2(), -400);
  EXPECT_EQ(moving.plan.options().end_speed_mm_s(), 25);
}

TEST_F(InMotion, PartsOfAPathJoin) {
  v1::PlanOptions first = options(), second = options();
  first.set_end_speed_mm_s(80);
  second.set_start_speed_mm_s(80);
  const Motion whole = motion(options(), path({0, 0, 60, 0}));
  const Motion from = motion(first, path({0, 0, 30, 0})), to = motion(second, path({30, 0, 60, 0}));
  EXPECT_EQ(from.position.back(), to.position.front());
  EXPECT_EQ(from.velocity.back(), to.velocity.front());
  const double together = from.plan.summary().cycle_time_s() + to.plan.summary().cycle_time_s();
  EXPECT_GT(together, whole.plan.summary().cycle_time_s());
  EXPECT_LT(together, whole.plan.summary().cycle_time_s() + 0.05);
}

TEST_F(InMotion, IsAnotherPlanThanAtRest) {
  v1::PlanOptions at_rest = options(), moving = options();
  at_rest.set_start_speed_mm_s(-0.0);
  moving.set_end_speed_mm_s(5);
  const auto name = [this](const v1::PlanOptions& asked) { return motion(asked, right_angle()).plan.name(); };
  EXPECT_EQ(name(at_rest), name(options()));
  EXPECT_NE(name(moving), name(options()));
}

TEST_F(InMotion, WhatCannotBeIsRefused) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {-1.0, kNan, 1e7, double(INFINITY)}) {
    v1::PlanOptions start = options(), end = options();
    start.set_start_speed_mm_s(bad);
    EXPECT_TRUE(refuses_field(create(start), "options.start_speed_mm_s"));
    end.set_end_speed_mm_s(bad);
    EXPECT_TRUE(refuses_field(create(end), "options.end_speed_mm_s"));
  }
  v1::PlanOptions asked = options();
  asked.set_start_acceleration_mm_s2(kNan);
  EXPECT_TRUE(refuses_field(create(asked), "options.start_acceleration_mm_s2"));
  asked = options();
  asked.set_start_acceleration_mm_s2(9000);
  EXPECT_TRUE(refuses_field(create(asked), "options.start_acceleration_mm_s2")) << "more than the axes can";
  asked = options();
  asked.set_start_speed_mm_s(500);
  EXPECT_TRUE(refuses_field(create(asked), "options.start_speed_mm_s")) << "faster than the axes can";
  asked = options();
  asked.set_end_speed_mm_s(500);
  EXPECT_TRUE(refuses_field(create(asked), "options.end_speed_mm_s")) << "faster than the path allows";
  EXPECT_EQ(create(asked).error_message().find("options.end_speed_mm_s: is 500"), 0U) << create(asked).error_message();
}

}  // namespace
}  // namespace kcs::service::test
