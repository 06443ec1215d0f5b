#include "client/gateway/lateness.h"

#include <gtest/gtest.h>

namespace kcs::gateway {
namespace {

TEST(Lateness, PercentilesAreThoseOfWhatWasRecorded) {
  Lateness lateness;
  for (int microsecond = 0; microsecond < 1000; ++microsecond) lateness.record(1000 * microsecond + 500);
  EXPECT_EQ(lateness.percentile_us(0.5), 500);
  EXPECT_EQ(lateness.percentile_us(0.99), 990);
  EXPECT_EQ(lateness.percentile_us(0.999), 999);
  EXPECT_EQ(lateness.max_us(), 999.5);
  EXPECT_EQ(lateness.percentile_us(1), 999.5);
}

TEST(Lateness, OneVeryLateTickShowsInTheMaximumOnly) {
  Lateness lateness;
  for (int tick = 0; tick < 9999; ++tick) lateness.record(10'000);
  lateness.record(50'000'000);
  EXPECT_EQ(lateness.percentile_us(0.999), 11);
  EXPECT_EQ(lateness.max_us(), 50'000);
  EXPECT_EQ(lateness.percentile_us(1), 50'000);
}

TEST(Lateness, WithoutTicksThereIsNone) {
  const Lateness lateness;
  EXPECT_EQ(lateness.percentile_us(0.5), 0);
  EXPECT_EQ(lateness.max_us(), 0);
}

}  // namespace
}  // namespace kcs::gateway
