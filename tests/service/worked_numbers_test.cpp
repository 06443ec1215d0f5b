// The paper's worked example, asked for over a real socket: a right angle, two 10 mm legs, rest to rest, F = 100 mm/s,
// A = 2500 mm/s², J = 2e5 mm/s³, tolerance as the distance from the corner (Tajima and Sencer 2016).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/service/test_server.h"

namespace kcs::service::test {
namespace {

struct Worked {
  v1::CornerStrategy strategy;
  double tolerance;  // mm
  double speed;      // mm/s
  double total;      // s
};

class WorkedNumbers : public ::testing::TestWithParam<Worked> {
 protected:
  // Within 0.1 %.
  static void expect_close(double value, double expected) { EXPECT_NEAR(value, expected, expected * 1e-3); }

  v1::Plan plan() {
    v1::PlanOptions asked = options(2);
    asked.set_strategy(GetParam().strategy);
    asked.set_tolerance_kind(v1::TOLERANCE_KIND_CORNER_DISTANCE);
    asked.set_tolerance_mm(GetParam().tolerance);
    const auto answer = server_.create({request(asked), request(right_angle())});
    EXPECT_TRUE(answer.status.ok()) << answer.status.error_message();
    return answer.message;
  }

  TestServer server_;
};

TEST_P(WorkedNumbers, ComeOutOfSummaryAndCorners) {
  const v1::Plan plan = this->plan();
  expect_close(plan.summary().cycle_time_s(), GetParam().total);
  const auto corners = server_.corners(plan.name()).message;
  ASSERT_EQ(corners.size(), 1U);
  EXPECT_EQ(corners[0].strategy(), GetParam().strategy);
  expect_close(corners[0].speed_mm_s(), GetParam().speed);
  expect_close(corners[0].deviation_mm(), GetParam().tolerance);
  EXPECT_NEAR(corners[0].angle_deg(), 90, 1e-9);
  if (GetParam().strategy == v1::CORNER_STRATEGY_UNINTERRUPTED) {
    const bool jerk_limited = GetParam().tolerance < 0.05;
    expect_close(corners[0].boundary_acceleration_mm_s2(), jerk_limited ? 2385.6 : 2500);
    expect_close(corners[0].duration_s(), jerk_limited ? 0.011928 : 0.036846);
  } else {
    EXPECT_NEAR(corners[0].boundary_acceleration_mm_s2(), 0, 1e-9);
  }
}

TEST_P(WorkedNumbers, ComeOutOfTheSetpoints) {
  constexpr double kPeriod = 1e-5;
  auto request = setpoints(plan().name(), kPeriod);
  request.add_channels(v1::CHANNEL_VELOCITY);
  const auto answer = server_.stream(request);
  ASSERT_TRUE(answer.status.ok());
  const auto x = column(answer.message, 0);
  const auto y = column(answer.message, 1);
  const auto vx = column(answer.message, 0, &v1::SetpointBatch::velocity_mm_s);
  const auto vy = column(answer.message, 1, &v1::SetpointBatch::velocity_mm_s);
  expect_close(static_cast<double>(x.size() - 1) * kPeriod, GetParam().total);

  // The corner begins where Y starts to move. X had the speed V just before.
  const auto begin = static_cast<std::size_t>(
      std::find_if(vy.begin(), vy.end(), [](double v) { return std::abs(v) > 1e-9; }) - vy.begin());
  ASSERT_GT(begin, 0U);
  expect_close(vx[begin - 1], GetParam().speed);
  double nearest = INFINITY;
  for (std::size_t i = 0; i < x.size(); ++i) nearest = std::min(nearest, std::hypot(x[i] - 10, y[i]));
  expect_close(nearest, GetParam().tolerance);
}

INSTANTIATE_TEST_SUITE_P(RightAngle, WorkedNumbers,
                         ::testing::Values(Worked{v1::CORNER_STRATEGY_INTERRUPTED, 0.1, 32.995, 0.29605},
                                           Worked{v1::CORNER_STRATEGY_INTERRUPTED, 0.01, 7.1138, 0.30970},
                                           Worked{v1::CORNER_STRATEGY_UNINTERRUPTED, 0.1, 46.058, 0.28999},
                                           Worked{v1::CORNER_STRATEGY_UNINTERRUPTED, 0.01, 14.2276, 0.29307}),
                         [](const auto& worked) {
                           return std::string(worked.param.strategy == v1::CORNER_STRATEGY_INTERRUPTED
                                                  ? "Interrupted"
                                                  : "Uninterrupted") +
                                  (worked.param.tolerance < 0.05 ? "Fine" : "Coarse");
                         });

}  // namespace
}  // namespace kcs::service::test
