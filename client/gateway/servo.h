// The control loops of one drive: a P position loop around a PI velocity loop, with velocity feed-forward.
#pragma once

namespace kcs::gateway {

// How a drive's loops are tuned.
struct ServoGains {
  double position_per_s = 0;       // velocity asked for per position error, (mm/s)/mm
  double velocity_n_s_per_mm = 0;  // force per velocity error, N/(mm/s)
  double integral_n_per_mm = 0;    // force per velocity error and second, N/mm
  double filter_rad_s = 0;         // corner frequency of the filter on the measured velocity
  double feed_forward = 1;         // share of the commanded velocity that is fed forward; 1: all of it
};

// Gains for a slide of `mass_kg` with which the position feedback alone (without feed-forward) follows a sine of
// `bandwidth_hz` with 1/√2 of its amplitude: the −3 dB bandwidth of the closed loops, which the paper matches at 35 Hz.
//
// The usual rule for cascades makes each loop four times faster than the one around it. With p the speed of the
// position loop (rad/s): position gain K_p = p; velocity gain K_v = m·4p, so that the velocity loop crosses over at 4p;
// integral K_i = K_v·p, which damps the velocity loop critically; and, as the measured velocity is a difference of
// encoder counts and needs smoothing, a first-order filter on it at 16p. For a mass, the closed loops are then, with σ
// = s/p,
//   X/X_commanded = 4(σ + 1)(1 + σ/16) / (σ³(1 + σ/16) + 4σ(σ + 1) + 4(σ + 1)(1 + σ/16)),
// the same for every mass and bandwidth. Its magnitude is 1/√2 at |σ| = 1.4269, so p = 2π·bandwidth/1.4269.
// The sampling, left out here, moves the bandwidth by about a per cent at 35 Hz and 0.1 ms.
ServoGains tune_servo(double mass_kg, double bandwidth_hz);

// One run of the loops each sampling time.
class Servo {
 public:
  // force_limit_n: the largest force that the motor gives, > 0. position_mm: what the encoder reads at first.
  Servo(const ServoGains& gains, double force_limit_n, double position_mm);

  // The force in newtons for the coming `seconds`, from the commanded position and velocity and the encoder's position.
  double force_n(double commanded_mm, double commanded_mm_s, double measured_mm, double seconds);

 private:
  ServoGains gains_;
  double force_limit_;         // N
  double last_measured_;       // mm
  double filtered_speed_ = 0;  // mm/s
  double integral_ = 0;        // N
};

}  // namespace kcs::gateway
