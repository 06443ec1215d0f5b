#include "client/gateway/servo.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace kcs::gateway {
namespace {

// Each loop of the cascade is this much faster than the one around it.
constexpr double kCascadeRatio = 4;
// The bandwidth of the closed loops, in units of the position loop's speed; servo.h derives it.
constexpr double kBandwidthRatio = 1.4269;
constexpr double kMillimetresPerMetre = 1000;

}  // namespace

ServoGains tune_servo(double mass_kg, double bandwidth_hz) {
  const double position_loop = 2 * std::numbers::pi * bandwidth_hz / kBandwidthRatio;  // rad/s
  const double velocity_loop = kCascadeRatio * position_loop;
  ServoGains gains;
  gains.position_per_s = position_loop;
  gains.velocity_n_s_per_mm = mass_kg * velocity_loop / kMillimetresPerMetre;
  gains.integral_n_per_mm = gains.velocity_n_s_per_mm * position_loop;
  gains.filter_rad_s = kCascadeRatio * velocity_loop;
  return gains;
}

Servo::Servo(const ServoGains& gains, double force_limit_n, double position_mm)
    : gains_(gains), force_limit_(force_limit_n), last_measured_(position_mm) {}

double Servo::force_n(double commanded_mm, double commanded_mm_s, double measured_mm, double seconds) {
  const double raw_speed = (measured_mm - last_measured_) / seconds;
  last_measured_ = measured_mm;
  filtered_speed_ -= std::expm1(-gains_.filter_rad_s * seconds) * (raw_speed - filtered_speed_);

  const double wanted_speed =
      gains_.feed_forward * commanded_mm_s + gains_.position_per_s * (commanded_mm - measured_mm);
  const double speed_error = wanted_speed - filtered_speed_;
  const double wanted_force = gains_.velocity_n_s_per_mm * speed_error + integral_;
  const double force = std::clamp(wanted_force, -force_limit_, force_limit_);
  // The integral waits while the motor is at its limit: it would only grow, and overshoot later.
  if (force == wanted_force) integral_ += gains_.integral_n_per_mm * speed_error * seconds;
  return force;
}

}  // namespace kcs::gateway
