// Kinematic corner smoothing with uninterrupted acceleration (Tajima and Sencer 2016, section 2.3): the tool enters
// braking, leaves accelerating, and one constant-jerk phase joins the two.
#pragma once

#include <vector>

#include "server/motion/phase.h"
#include "server/planning/corner_geometry.h"
#include "server/planning/corner_motion.h"

namespace kcs::planning {

class Uninterrupted {
 public:
  // corner.cut > 0
  Uninterrupted(const CornerGeometry& corner, const AxisLimits& limits);

  double max_speed() const { return max_speed_; }
  CornerMotion at(double speed) const;
  double speed_at_level(double level, double leg_jerk) const;
  void append_phases(const CornerGeometry& corner, double speed, std::vector<motion::Phase>& phases) const;

 private:
  double acceleration(double speed) const;  // Ac, mm/s²

  double half_sine_ = 0;         // sin(θ2/2)
  double jerk_ = 0;              // Ac² ≤ 2 V jerk_; at most min J_i/|ts_i + te_i|, mm/s³
  double max_speed_ = 0;         // mm/s
  double max_acceleration_ = 0;  // Ac at the greatest speed, mm/s²
};

}  // namespace kcs::planning
