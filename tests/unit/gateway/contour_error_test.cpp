#include "client/gateway/contour_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace kcs::gateway {
namespace {

constexpr std::size_t kWindow = 10;

TEST(ContourError, LagAlongALineIsNoContourError) {
  ContourError error(kWindow);
  const Vector along(3, 4, 12);
  for (int tick = 0; tick < 100; ++tick) error.add(tick * along, std::max(0.0, tick - 3.7) * along);
  EXPECT_NEAR(error.finish().max_mm, 0, 1e-9);
}

TEST(ContourError, OffsetFromALineIsItsDistance) {
  ContourError error(kWindow);
  for (int tick = 0; tick < 100; ++tick) error.add(Vector(tick, 0, 0), Vector(tick, 0.003, -0.004));
  const ContourFigures figures = error.finish();
  EXPECT_NEAR(figures.max_mm, 0.005, 1e-12);
  EXPECT_NEAR(figures.rms_mm, 0.005, 1e-12);
}

TEST(ContourError, LargerCircleIsOffByTheDifferenceOfRadii) {
  ContourError error(kWindow);
  constexpr double kTurn = 2 * std::numbers::pi / 1000;
  for (int tick = 0; tick < 1000; ++tick) {
    const Vector direction(std::cos(kTurn * tick), std::sin(kTurn * tick), 0);
    error.add(10 * direction, 10.02 * direction);
  }
  const ContourFigures figures = error.finish();
  // The chords of the commanded circle lie up to r(1 − cos(turn/2)) = 0.05 µm inside it.
  EXPECT_NEAR(figures.rms_mm, 0.02, 1e-4);
  EXPECT_NEAR(figures.max_mm, 0.02, 1e-4);
}

TEST(ContourError, LargestErrorIsFoundWithItsPlaceAndTick) {
  ContourError error(kWindow);
  for (int tick = 0; tick < 100; ++tick) {
    error.add(Vector(tick, 0, 0), Vector(tick, tick == 42 ? 0.5 : 0.0, 0));
  }
  const ContourFigures figures = error.finish();
  EXPECT_EQ(figures.max_index, 42u);
  EXPECT_EQ(figures.max_position_mm, Vector(42, 0.5, 0));
  EXPECT_NEAR(figures.max_mm, 0.5, 1e-12);
  EXPECT_NEAR(figures.rms_mm, 0.5 / std::sqrt(100), 1e-12);
}

TEST(ContourError, AheadOfTheCommandCountsAsLittleAsBehind) {
  ContourError error(kWindow);
  for (int tick = 0; tick < 100; ++tick) error.add(Vector(tick, 0, 0), Vector(std::min(99.0, tick + 5.2), 0, 0));
  EXPECT_NEAR(error.finish().max_mm, 0, 1e-9);
}

TEST(ContourError, AnotherPassOfThePathIsNotTakenForThisOne) {
  // Two passes 1 mm apart; during the first the machine is where the second will be.
  ContourError error(kWindow);
  for (int tick = 0; tick < 50; ++tick) error.add(Vector(tick, 0, 0), Vector(tick, 1, 0));
  for (int tick = 0; tick < 50; ++tick) error.add(Vector(50 - tick, 1, 0), Vector(50 - tick, 1, 0));
  EXPECT_NEAR(error.finish().max_mm, 1, 1e-12);
}

TEST(ContourError, ShortMotionsAreMeasuredToo) {
  ContourError none(kWindow);
  EXPECT_EQ(none.finish().max_mm, 0);
  ContourError one(kWindow);
  one.add(Vector(1, 1, 1), Vector(1, 1, 1.5));
  EXPECT_NEAR(one.finish().max_mm, 0.5, 1e-12);
  ContourError standing(kWindow);
  for (int tick = 0; tick < 3; ++tick) standing.add(Vector(1, 1, 1), Vector(1, 1, 1.5));
  EXPECT_NEAR(standing.finish().rms_mm, 0.5, 1e-12);
}

}  // namespace
}  // namespace kcs::gateway
