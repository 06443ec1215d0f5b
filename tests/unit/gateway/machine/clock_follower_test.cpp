#include "client/gateway/machine/clock_follower.h"

#include <gtest/gtest.h>

#include <cmath>

namespace kcs::gateway {
namespace {

constexpr double kPeriodNs = 1e6;

class ClockFollowerDrift : public testing::TestWithParam<double> {};

// Ten minutes of ticks.
TEST_P(ClockFollowerDrift, TicksKeepInStepWithTheDrives) {
  const double drives_clock = 1 + GetParam() * 1e-6;
  ClockFollower follower(kPeriodNs);
  double now = 0;      // of the computer
  double largest = 0;  // out of step
  double shift = 0;
  double ahead = 0;
  for (int tick = 1; tick <= 600'000; ++tick) {
    now += kPeriodNs + shift;
    ahead = now * drives_clock - tick * kPeriodNs;
    largest = std::max(largest, std::abs(ahead));
    shift = follower.shift_ns(ahead);
    ASSERT_LE(std::abs(shift), kPeriodNs / 100);
  }
  EXPECT_LT(largest, kPeriodNs / 10) << "less than half a period: none is dropped, none given twice";
  EXPECT_LT(std::abs(ahead), 10);
}

INSTANTIATE_TEST_SUITE_P(PartsPerMillion, ClockFollowerDrift, testing::Values(-500.0, -50.0, 0.0, 3.0, 500.0));

}  // namespace
}  // namespace kcs::gateway
