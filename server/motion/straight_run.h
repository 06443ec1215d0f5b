// Points that lie on one straight line, as far as their coordinates can tell.
#pragma once

#include "server/motion/phase.h"

namespace kcs::motion {

// A position cannot be known better than the doubles around it: rounding of sums of a few such numbers, mm.
double position_rounding(const Vector& position);

// A straight line that grows by points, one after the other, as long as none of them leaves it.
class StraightRun {
 public:
  // start ≠ end
  StraightRun(const Vector& start, const Vector& end);

  // Goes on to `point` if that is forward and if no point of the run is then beside the line by more than rounding.
  // Otherwise nothing changes.
  bool extend(const Vector& point);

  const Vector& start() const { return start_; }
  const Vector& end() const { return end_; }
  const Vector& direction() const { return direction_; }  // unit tangent
  double length() const { return length_; }               // mm

 private:
  Vector start_, end_, direction_;
  double length_;
  double drift_ = 0;  // bound on how far the points in between are beside the line, mm
};

}  // namespace kcs::motion
