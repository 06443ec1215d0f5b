#include "client/gateway/periodic_timer.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace kcs::gateway {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::duration;
using std::chrono::milliseconds;

double seconds_since(Clock::time_point start) { return duration<double>(Clock::now() - start).count(); }

TEST(PeriodicTimer, KeepsThePeriodOverManyTicks) {
  const auto start = Clock::now();
  PeriodicTimer timer(0.002);
  std::int64_t late = 0;
  for (int tick = 0; tick < 100; ++tick) late = timer.wait();
  EXPECT_GE(seconds_since(start), 0.2);
  const double missed = 0.002 * static_cast<double>(timer.missed());
  // No drift, however late we woke.
  EXPECT_NEAR(seconds_since(start) - 1e-9 * static_cast<double>(late) - missed, 0.2, 0.005);
}

TEST(PeriodicTimer, GoesOnAPeriodApartWhereItWasKeptFromRunning) {
  constexpr double kPeriod = 0.01;
  PeriodicTimer timer(kPeriod);
  timer.wait();
  std::this_thread::sleep_for(milliseconds(45));  // four more deadlines go by
  const auto late = static_cast<double>(timer.wait()) * 1e-9;
  EXPECT_GE(late, 0.03);
  EXPECT_GE(timer.missed(), 3u);
  const auto missed = static_cast<double>(timer.missed());
  const auto resumed = Clock::now();
  double more = 0;
  for (int tick = 0; tick < 4; ++tick) more = static_cast<double>(timer.wait()) * 1e-9;
  // The first may come sooner by what the late one was late beyond whole periods.
  EXPECT_GE(seconds_since(resumed) - more, 4 * kPeriod - (late - missed * kPeriod) - 0.001);
  EXPECT_NEAR(timer.elapsed_ns() * 1e-9, 6 * kPeriod, 1e-9);  // ticks are all that counts
}

}  // namespace
}  // namespace kcs::gateway
