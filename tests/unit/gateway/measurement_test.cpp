#include "client/gateway/measurement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "client/gateway/observer.h"

namespace kcs::gateway {
namespace {

constexpr double kPeriod = 0.001;  // s

TEST(Measurement, TellsFollowingErrorFromContourError) {
  Measurement measurement(kPeriod);
  constexpr int kTicks = 1000;
  for (int tick = 0; tick < kTicks; ++tick) {
    // Up to 2 mm behind on X, along the path; 0.01 mm beside it on Y.
    measurement.add({.commanded_mm = Vector(tick, 0, 0), .actual_mm = Vector(std::max(0, tick - 2), 0.01, 0)});
  }
  const RunFigures figures = measurement.finish();
  EXPECT_EQ(figures.ticks, 1000u);
  EXPECT_NEAR(figures.following_rms_mm.x(), std::sqrt((0 + 1 + 4.0 * (kTicks - 2)) / kTicks), 1e-12);
  EXPECT_NEAR(figures.following_max_mm.x(), 2, 1e-12);
  EXPECT_NEAR(figures.following_max_mm.y(), 0.01, 1e-12);
  EXPECT_EQ(figures.following_max_mm.z(), 0);
  EXPECT_NEAR(figures.contour.rms_mm, 0.01, 1e-12);
}

TEST(Measurement, BufferLevelCountsOnlyWhileMoreIsToCome) {
  Measurement measurement(kPeriod);
  for (const std::size_t buffered : {100, 40, 80, 60}) measurement.add({.buffered = buffered, .filling = true});
  for (const std::size_t buffered : {2, 1, 0}) measurement.add({.buffered = buffered, .filling = false});
  const RunFigures figures = measurement.finish();
  ASSERT_TRUE(figures.buffer_min_s && figures.buffer_mean_s);
  EXPECT_NEAR(*figures.buffer_min_s, 0.040, 1e-12);
  EXPECT_NEAR(*figures.buffer_mean_s, 0.070, 1e-12);
}

TEST(Measurement, NoBufferLevelIfAllWasThereFromTheStart) {
  Measurement measurement(kPeriod);
  measurement.add({.buffered = 5, .filling = false});
  EXPECT_FALSE(measurement.finish().buffer_min_s);
}

TEST(Observer, MeasuresEveryTickThatWasPutBeforeTheEnd) {
  std::uint64_t progress = 0;
  Observer observer(
      {.axes = 2, .period_s = kPeriod, .record = std::nullopt, .on_progress = [&progress](std::uint64_t ticks) {
         progress = ticks;
       }});
  for (int tick = 0; tick < 50'000; ++tick) ASSERT_TRUE(observer.trace().put({.commanded_mm = Vector(tick, 0, 0)}));
  EXPECT_EQ(observer.finish().ticks, 50'000u);
  EXPECT_EQ(progress, 50'000u);
}

}  // namespace
}  // namespace kcs::gateway
