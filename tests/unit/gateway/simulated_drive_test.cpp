#include "client/gateway/simulated_drive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "client/gateway/simulated_table.h"

namespace kcs::gateway {
namespace {

constexpr double kPeriod = 1e-4;           // s
constexpr double kResolution = 0.7125e-3;  // mm

// A drive to which the linear theory of the loops applies: no dry friction, no visible encoder counts, no force limit.
DriveParameters ideal(double mass_kg) {
  return {.slide = {.mass_kg = mass_kg}, .force_limit_n = 1e12, .bandwidth_hz = 35, .encoder_resolution_mm = 1e-9};
}

ServoGains gains_of(const DriveParameters& parameters) {
  return tune_servo(parameters.slide.mass_kg, parameters.bandwidth_hz);
}

// The amplitude with which the position feedback alone follows a sine of 1 mm.
double followed_amplitude(double mass_kg, double frequency_hz) {
  const DriveParameters parameters = ideal(mass_kg);
  ServoGains gains = gains_of(parameters);
  gains.feed_forward = 0;
  SimulatedDrive drive(parameters, gains, 0);
  double largest = 0;
  for (int tick = 1; tick <= 20000; ++tick) {
    drive.follow(std::sin(2 * std::numbers::pi * frequency_hz * tick * kPeriod), kPeriod);
    if (tick > 10000) largest = std::max(largest, std::abs(drive.slide().position_mm()));
  }
  return largest;
}

// Following error (commanded less true position) at the end of a long move at constant velocity, from rest.
double error_on_ramp(SimulatedDrive drive, double velocity_mm_s) {
  double commanded = 0;
  for (int tick = 1; tick <= 10000; ++tick) {
    commanded = velocity_mm_s * tick * kPeriod;
    drive.follow(commanded, kPeriod);
  }
  return commanded - drive.slide().position_mm();
}

class DriveOfMass : public testing::TestWithParam<double> {};

TEST_P(DriveOfMass, PositionFeedbackHasABandwidthOf35Hertz) {
  double followed = 10;  // Hz: passes through
  double damped = 100;   // Hz: does not
  while (damped - followed > 0.1) {
    const double middle = (followed + damped) / 2;
    (followed_amplitude(GetParam(), middle) > std::numbers::sqrt2 / 2 ? followed : damped) = middle;
  }
  EXPECT_NEAR(followed, 35, 0.02 * 35);  // the gains leave out what the sampling costs
}

TEST_P(DriveOfMass, PositionFeedbackHasTheTransferFunctionThatItsGainsWereMadeFor) {
  const double p = gains_of(ideal(GetParam())).position_per_s;
  for (const double frequency : {5.0, 10.0, 20.0, 50.0}) {
    const std::complex<double> s(0, 2 * std::numbers::pi * frequency / p);
    const auto filter = 1.0 + s / 16.0;
    const auto response =
        4.0 * (s + 1.0) * filter / (s * s * s * filter + 4.0 * s * (s + 1.0) + 4.0 * (s + 1.0) * filter);
    EXPECT_NEAR(followed_amplitude(GetParam(), frequency), std::abs(response), 0.01) << frequency << " Hz";
  }
}

TEST_P(DriveOfMass, WithoutFeedForwardARampIsFollowedAtVelocityOverPositionGain) {
  const DriveParameters parameters = ideal(GetParam());
  ServoGains gains = gains_of(parameters);
  gains.feed_forward = 0;
  // The loops see the command of the beginning of each sampling time: one half of it later on average, so allow that.
  EXPECT_NEAR(error_on_ramp(SimulatedDrive(parameters, gains, 0), 100), 100 / gains.position_per_s, 100 * kPeriod);
}

TEST_P(DriveOfMass, WithFeedForwardARampIsFollowedWithoutError) {
  EXPECT_NEAR(error_on_ramp(SimulatedDrive(ideal(GetParam()), 0), 100), 0, 1e-6);
}

TEST_P(DriveOfMass, AStepSettlesWithoutErrorAndWithoutRinging) {
  const DriveParameters parameters = ideal(GetParam());
  ServoGains gains = gains_of(parameters);
  gains.feed_forward = 0;
  SimulatedDrive drive(parameters, gains, 0);
  double largest = 0;
  for (int tick = 0; tick < 5000; ++tick) {
    drive.follow(1, kPeriod);
    largest = std::max(largest, drive.slide().position_mm());
  }
  EXPECT_NEAR(drive.slide().position_mm(), 1, 1e-6);
  EXPECT_LT(largest, 1.2);
}

INSTANTIATE_TEST_SUITE_P(Masses, DriveOfMass, testing::Values(12.0, 40.0));

TEST(SimulatedDrive, CommandInPiecesOfAnyPeriodLeadsToTheSamePlace) {
  for (const double period : {1e-5, 1e-4, 2.5e-4, 1e-3, 4e-3}) {
    SimulatedDrive drive(ideal(12), 0);
    const int ticks = static_cast<int>(std::lround(0.5 / period));
    for (int tick = 1; tick <= ticks; ++tick) drive.follow(100 * period * tick, period);
    EXPECT_NEAR(drive.slide().position_mm(), 50, 1e-4) << "period " << period;
  }
}

TEST(SimulatedDrive, EncoderReadsWholeCounts) {
  SimulatedDrive drive(table_drives().at(0), 0);
  for (int tick = 1; tick <= 1000; ++tick) {
    drive.follow(0.1 * tick * kPeriod, kPeriod);
    const double counts = drive.encoder_mm() / kResolution;
    ASSERT_NEAR(counts, std::round(counts), 1e-9);
    ASSERT_NEAR(drive.encoder_mm(), drive.slide().position_mm(), kResolution / 2 + 1e-12);
  }
}

TEST(SimulatedDrive, ForceLimitLimitsTheAcceleration) {
  DriveParameters parameters = ideal(10);
  parameters.force_limit_n = 50;  // 5000 mm/s²
  SimulatedDrive drive(parameters, 0);
  for (int tick = 0; tick < 100; ++tick) drive.follow(1000, kPeriod);
  EXPECT_NEAR(drive.slide().speed_mm_s(), 50, 1e-6);
}

TEST(SimulatedDrive, FrictionLeavesAPeakWhenTheMotionTurnsRound) {
  // A slow sine: inertia plays no part, so what error there is comes from friction, and is largest after a reversal.
  const auto largest_error = [](const DriveParameters& parameters) {
    SimulatedDrive drive(parameters, 0);
    double largest = 0;
    for (int tick = 1; tick <= 20000; ++tick) {
      const double commanded = 5 * std::sin(2 * std::numbers::pi * tick * kPeriod);
      drive.follow(commanded, kPeriod);
      if (tick > 10000) largest = std::max(largest, std::abs(commanded - drive.slide().position_mm()));
    }
    return largest;
  };
  DriveParameters with = table_drives().at(0);
  DriveParameters without = with;
  without.slide.coulomb_n = without.slide.static_n = 0;
  EXPECT_LT(largest_error(without), 1.5 * kResolution);
  // A step of d = 2·Coulomb friction/mass, in loops of K_v/m = ω and K_p, moves the slide by some tenths of d/(ω·K_p).
  const ServoGains gains = gains_of(with);
  const double scale = 2 * with.slide.coulomb_n / gains.velocity_n_s_per_mm / gains.position_per_s;
  EXPECT_GT(largest_error(with), 0.2 * scale);
  EXPECT_LT(largest_error(with), scale);
}

}  // namespace
}  // namespace kcs::gateway
