// Kinematic corner smoothing with interrupted acceleration (Tajima and Sencer 2016, section 2.2): every axis changes
// its velocity from V·ts to V·te with one jerk-limited profile, without acceleration at both ends.
#pragma once

#include <vector>

#include "server/motion/phase.h"
#include "server/planning/corner_geometry.h"
#include "server/planning/corner_motion.h"

namespace kcs::planning {

class Interrupted {
 public:
  Interrupted(const CornerGeometry& corner, const AxisLimits& limits);

  double max_speed() const { return max_speed_; }
  CornerMotion at(double speed) const;
  double speed_at_level(double level, double /*leg_jerk*/) const { return level; }
  void append_phases(const CornerGeometry& corner, double speed, std::vector<motion::Phase>& phases) const;

 private:
  // The profile's phases last T1, T2, T1.
  struct Times {
    double t1 = 0, t2 = 0;
  };
  Times times(double speed) const;

  double turn_ = 0;          // |D|
  double acceleration_ = 0;  // a* = min A_i/|D_i|, mm/s²
  double jerk_ = 0;          // j* = min J_i/|D_i|, mm/s³
  double max_speed_ = 0;     // mm/s
};

}  // namespace kcs::planning
