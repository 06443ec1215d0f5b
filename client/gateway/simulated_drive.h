// One axis of a machine that exists only in the computer: slide, motor, encoder and the drive's control loops.
#pragma once

#include "client/gateway/servo.h"
#include "client/gateway/slide.h"

namespace kcs::gateway {

struct DriveParameters {
  SlideParameters slide;
  double force_limit_n = 1;             // largest force of the motor, > 0
  double bandwidth_hz = 35;             // of the position feedback, −3 dB; see tune_servo
  double encoder_resolution_mm = 1e-6;  // > 0
};

// A drive takes one commanded position each setpoint period, as drives in cyclic synchronous position mode do, and
// moves towards it in a straight line over the coming period; the slope of that line is the velocity that it feeds
// forward. Its own loops run every 0.1 ms (the paper's sampling time) or oftener, and the slide is followed ten times
// finer still.
class SimulatedDrive {
 public:
  // At rest at `position_mm`.
  SimulatedDrive(const DriveParameters& parameters, double position_mm);

  // With gains of one's own instead of those for the bandwidth.
  SimulatedDrive(const DriveParameters& parameters, const ServoGains& gains, double position_mm);

  // Moves for `period_s` seconds (> 0) towards `commanded_mm`, which is due at their end.
  void follow(double commanded_mm, double period_s);

  // What the encoder reads, mm.
  double encoder_mm() const;

  // Where the slide really is.
  const Slide& slide() const { return slide_; }

 private:
  double encoder_resolution_;  // mm
  Slide slide_;
  Servo servo_;
  double commanded_;  // mm; where the last period's command ended
};

}  // namespace kcs::gateway
