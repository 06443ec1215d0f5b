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
  EXPECT_NEAR(seconds_since(start) - 1e-9 * static_cast<double>(late), 0.2, 0.005);  // no drift, however late we woke
}

TEST(PeriodicTimer, CatchesUpAfterALateTickWithoutSkippingAny) {
  const auto start = Clock::now();
  PeriodicTimer timer(0.01);
  timer.wait();
  std::this_thread::sleep_for(milliseconds(45));  // four more deadlines go by
  for (int tick = 0; tick < 4; ++tick) EXPECT_GE(timer.wait(), 0);
  EXPECT_LT(seconds_since(start), 0.5);
  timer.wait();
  EXPECT_GE(seconds_since(start), 0.06);  // the sixth deadline is where it always was
}

}  // namespace
}  // namespace kcs::gateway
