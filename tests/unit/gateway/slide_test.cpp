#include "client/gateway/slide.h"

#include <gtest/gtest.h>

#include <cmath>

namespace kcs::gateway {
namespace {

constexpr double kStep = 1e-5;  // s

void push_for(Slide& slide, double force_n, double seconds) {
  const int steps = static_cast<int>(std::lround(seconds / kStep));
  for (int i = 0; i < steps; ++i) slide.push(force_n, kStep);
}

TEST(Slide, WithoutFrictionAccelerationIsForceOverMass) {
  Slide slide({.mass_kg = 10}, 5);
  push_for(slide, 20, 0.1);                        // 2 m/s² = 2000 mm/s²
  EXPECT_NEAR(slide.speed_mm_s(), 200, 1e-9);      // a·t
  EXPECT_NEAR(slide.position_mm(), 5 + 10, 1e-9);  // a·t²/2
}

TEST(Slide, StaysAtRestBelowStaticFrictionAndBreaksLooseAboveIt) {
  const SlideParameters parameters = {.mass_kg = 10, .coulomb_n = 30, .static_n = 40};
  Slide held(parameters, 0);
  push_for(held, 39.9, 1);
  EXPECT_EQ(held.position_mm(), 0);
  push_for(held, -39.9, 1);
  EXPECT_EQ(held.position_mm(), 0);

  Slide loose(parameters, 0);
  push_for(loose, 40.1, 0.5);
  // Once it moves, Coulomb friction alone is left: (40.1 − 30) N / 10 kg, after a moment on Stribeck's curve.
  EXPECT_GT(loose.speed_mm_s(), 300);
  EXPECT_LT(loose.speed_mm_s(), 505);
}

TEST(Slide, CoastsToRestOverTheDistanceThatCoulombFrictionAllows) {
  Slide slide({.mass_kg = 10, .coulomb_n = 20, .static_n = 20}, 0);
  push_for(slide, 120, 0.01);  // (120 − 20) N / 10 kg for 10 ms: 100 mm/s
  ASSERT_NEAR(slide.speed_mm_s(), 100, 1e-9);
  const double start = slide.position_mm();
  push_for(slide, 0, 1);
  EXPECT_EQ(slide.speed_mm_s(), 0);
  EXPECT_NEAR(slide.position_mm() - start, 100 * 100 / (2 * 2000.0), 1e-6);  // v²/(2a), a = 2000 mm/s²
}

TEST(Slide, ReachesTheSpeedAtWhichViscousFrictionBalancesTheForce) {
  Slide slide({.mass_kg = 10, .viscous_n_s_per_mm = 0.5}, 0);
  push_for(slide, 50, 10.0 / 1000 / 0.5);                             // one time constant, m/b
  EXPECT_NEAR(slide.speed_mm_s(), 100 * (1 - std::exp(-1.0)), 0.02);  // exact but for the step
  push_for(slide, 50, 1);
  EXPECT_NEAR(slide.speed_mm_s(), 100, 1e-9);
}

TEST(Slide, FrictionNeverDrivesTheSlide) {
  Slide slide({.mass_kg = 1, .coulomb_n = 1000, .static_n = 1500}, 0);
  slide.push(2000, 1e-4);
  ASSERT_GT(slide.speed_mm_s(), 0);
  slide.push(0, 0.1);  // friction could turn the speed round many times over in so long a step
  EXPECT_EQ(slide.speed_mm_s(), 0);
}

}  // namespace
}  // namespace kcs::gateway
