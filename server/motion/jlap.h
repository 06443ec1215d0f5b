// The jerk-limited acceleration profile: from one speed and acceleration to another in the shortest time.
#pragma once

#include <array>

namespace kcs::motion {

// Motion along a line.
struct LinearState {
  double position = 0;      // mm
  double velocity = 0;      // mm/s
  double acceleration = 0;  // mm/s²
};

// A stretch of constant jerk along a line.
struct LinearPhase {
  double duration = 0;  // s, ≥ 0
  double jerk = 0;      // mm/s³

  LinearState end(const LinearState& start) const;
};

// Three phases: jerk one way, none, jerk the other way. Phases may have no duration.
using Jlap = std::array<LinearPhase, 3>;

// The fastest way from (v_start, a_start) to (v_end, a_end), in mm/s and mm/s², with |acceleration| ≤ a_max and
// |jerk| ≤ j_max. Exists for all |a_start|, |a_end| ≤ a_max; j_max > 0. Speeds in between may lie outside
// [v_start, v_end] where the boundary accelerations ask for it.
// Tajima and Sencer 2016, section 2.1, for both signs of every argument: the velocity change of an immediate
// transition of the acceleration decides which way the jerk goes first.
Jlap jlap(double v_start, double a_start, double v_end, double a_end, double a_max, double j_max);

// The way from speed `v` and acceleration `a` to rest of acceleration at speed `v_peak`, all ≥ 0: what a leg begins
// with, and, run backwards, what it ends with. Distance and time without building the phases, because the look-ahead
// asks for them many times.
struct Ramp {
  double distance = 0;  // mm
  double duration = 0;  // s
};
// v_peak ≥ v + a²/(2 j_max) and a ≤ a_max; values below by rounding are taken as equal.
Ramp ramp_to_peak(double v, double a, double v_peak, double a_max, double j_max);

}  // namespace kcs::motion
