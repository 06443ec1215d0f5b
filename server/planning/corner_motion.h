// A corner taken at one speed.
#pragma once

namespace kcs::planning {

struct CornerMotion {
  double speed = 0;         // V, entering along ts and leaving along te, mm/s
  double acceleration = 0;  // Ac: −Ac along ts at the entry, +Ac along te at the exit, mm/s², ≥ 0
  double length = 0;        // Lc, taken from each of the two legs, mm
  double duration = 0;      // s
  double cut = 0;           // ε, corner point to the middle of the smoothed corner, mm

  // The speed that a leg with tangential jerk limit `jerk` must reach so that the tool can arrive, or has when the
  // acceleration has died away after the corner, mm/s.
  double level(double jerk) const { return speed + acceleration * acceleration / (2 * jerk); }
};

}  // namespace kcs::planning
