// A corner between the paper's two. The tool brakes into it and accelerates out of it, as in Uninterrupted, while the
// acceleration across its course rises and falls, as in Interrupted; the axes' jerk is shared between the two. And it
// may swing off the leg to the inside before it turns, and when it has turned: then it touches the leg with the
// acceleration across it built up already, and turns faster.
//
// The second half of the corner, as motion along the outgoing leg and across it (half_corner.h); the first half is its
// mirror image, backwards in time. In the middle the acceleration is along the bisector, the velocity square to it.
//   across: acceleration a0 for a while, the hold; then down at constant jerk, through a1, where the curve touches the
//           leg, to −α a1, up to β a1 and down to 0. α and β are such that the swing ends on the leg; without one a1 =
//           0.
//   along:  at constant acceleration during the hold, then the jerk-limited profile up to the feed, as far as it comes.
#pragma once

#include <vector>

#include "server/motion/jlap.h"
#include "server/motion/phase.h"
#include "server/planning/corner_geometry.h"
#include "server/planning/corner_motion.h"
#include "server/planning/half_corner.h"

namespace kcs::planning {

// What there is to choose. All else follows from the limits and the tolerance.
struct Blend {
  double share = 0;  // of the jerk that both legs allow, used along them; what is left turns the tool. 0 < share < 1
  double swing = 0;  // a1 against the greatest that the tolerance and the limits allow, 0 to 1
};

class Blended {
 public:
  // Not for corners so nearly straight that the plane in which they lie is lost in rounding, nor for reversals: there
  // Interrupted and Uninterrupted lose hardly anything.
  static bool suits(const CornerGeometry& corner);

  // suits(corner), corner.cut > 0
  Blended(const CornerGeometry& corner, const AxisLimits& limits, const Blend& blend);

  // A slower corner has a shorter hold. Slower than without hold, all its phases are shortened in proportion at the
  // same jerk: speeds go with the square of the time, lengths with its cube.
  double max_speed() const { return unheld_.speed + gain_ * max_hold_; }
  CornerMotion at(double speed) const;
  double speed_at_level(double level, double leg_jerk) const;
  void append_phases(const CornerGeometry& corner, double speed, std::vector<motion::Phase>& phases) const;

 private:
  double half_time() const { return unheld_.duration / 2; }  // after the hold, s
  void shorten(double ratio);
  // When half the hold, `hold` (s), has passed since the middle.
  HalfState end_of_hold(const CornerGeometry& corner, double hold) const;

  motion::Jlap along_, across_;  // after the hold
  double acceleration_ = 0;      // in the middle, mm/s²
  double approach_ = 0;          // speed along the bisector that is left after the hold, mm/s
  double gain_ = 0;              // what half the hold adds to the speed, mm/s²
  double max_hold_ = 0;          // half of it, s
  CornerMotion unheld_;          // the fastest corner without a hold
};

}  // namespace kcs::planning
