#include "server/motion/jlap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace kcs::motion {
namespace {

LinearState end_of(const Jlap& profile, LinearState state) {
  for (const LinearPhase& phase : profile) state = phase.end(state);
  return state;
}

double duration_of(const Jlap& profile) { return profile[0].duration + profile[1].duration + profile[2].duration; }

TEST(Jlap, ReachesThePeakAccelerationWhenThereIsRoom) {
  const Jlap profile = jlap(0, 0, 100, 0, 2500, 2e5);
  EXPECT_NEAR(profile[0].duration, 0.0125, 1e-15);
  EXPECT_NEAR(profile[1].duration, 0.0275, 1e-15);
  EXPECT_NEAR(profile[2].duration, 0.0125, 1e-15);
}

TEST(Jlap, HasNoConstantAccelerationForASmallChange) {
  const Jlap profile = jlap(10, 0, 20, 0, 2500, 2e5);
  EXPECT_EQ(profile[1].duration, 0);
  // Equation 18 without its slip: (v_s + v_e)·sqrt(J|Δv|)/J.
  EXPECT_NEAR(end_of(profile, {0, 10, 0}).position, 30 * std::sqrt(2e5 * 10) / 2e5, 1e-12);
}

TEST(Jlap, KeepsTheStateWhenNothingChanges) { EXPECT_EQ(duration_of(jlap(50, 0, 50, 0, 2500, 2e5)), 0); }

TEST(Jlap, JoinsAnyTwoStatesInsideTheLimits) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> share(-1, 1);
  for (int i = 0; i < 200'000; ++i) {
    const double a_max = std::pow(10, 2 + 2 * share(random)), j_max = a_max * std::pow(10, 1 + share(random));
    const double v0 = 200 * share(random), v1 = 200 * share(random);
    const double a0 = a_max * share(random), a1 = a_max * share(random);
    const Jlap profile = jlap(v0, a0, v1, a1, a_max, j_max);
    LinearState state{0, v0, a0};
    for (const LinearPhase& phase : profile) {
      ASSERT_GE(phase.duration, 0);
      ASSERT_LE(std::abs(phase.jerk), j_max);
      state = phase.end(state);
      ASSERT_LE(std::abs(state.acceleration), a_max * (1 + 1e-12));
    }
    ASSERT_NEAR(state.velocity, v1, 1e-9 * (std::abs(v0) + std::abs(v1) + a_max * a_max / j_max)) << "case " << i;
    ASSERT_NEAR(state.acceleration, a1, 1e-9 * a_max) << "case " << i;
  }
}

// Against a search over all profiles of the kind "jerk to a peak acceleration, hold it, jerk to the end".
TEST(Jlap, IsTheShortest) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> share(-1, 1);
  constexpr double kAMax = 1000, kJMax = 20000;
  for (int i = 0; i < 2'000; ++i) {
    const double dv = 100 * share(random), a0 = kAMax * share(random), a1 = kAMax * share(random);
    const double found = duration_of(jlap(0, a0, dv, a1, kAMax, kJMax));
    for (int step = -500; step <= 500; ++step) {
      const double peak = kAMax * step / 500;
      if (peak == 0) continue;
      const double t1 = std::abs(peak - a0) / kJMax, t3 = std::abs(peak - a1) / kJMax;
      const double t2 = (dv - t1 * (a0 + peak) / 2 - t3 * (a1 + peak) / 2) / peak;
      if (t2 < 0) continue;
      ASSERT_LE(found, (t1 + t2 + t3) * (1 + 1e-9)) << "case " << i << ", peak " << peak;
    }
  }
}

TEST(Ramp, IsTheProfileToThePeak) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> share(0, 1);
  for (int i = 0; i < 20'000; ++i) {
    const double a_max = 2000, j_max = 1e5, v = 100 * share(random), a = a_max * share(random);
    const double peak = v + a * a / (2 * j_max) + 100 * share(random);
    const Jlap profile = jlap(v, a, peak, 0, a_max, j_max);
    const Ramp ramp = ramp_to_peak(v, a, peak, a_max, j_max);
    ASSERT_NEAR(ramp.duration, duration_of(profile), 1e-12);
    ASSERT_NEAR(ramp.distance, end_of(profile, {0, v, a}).position, 1e-10);
  }
}

}  // namespace
}  // namespace kcs::motion
