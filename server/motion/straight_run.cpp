#include "server/motion/straight_run.h"

#include <algorithm>
#include <limits>

namespace kcs::motion {

double position_rounding(const Vector& position) {
  return 16 * std::numeric_limits<double>::epsilon() * position.cwiseAbs().maxCoeff();
}

StraightRun::StraightRun(const Vector& start, const Vector& end)
    : start_(start), end_(end), direction_((end - start).normalized()), length_((end - start).norm()) {}

bool StraightRun::extend(const Vector& point) {
  const Vector way = point - start_;
  const double forward = way.dot(direction_);
  // Turning the line about its start to meet the new point moves none of the earlier ones farther than this.
  const double drift = drift_ + (way - forward * direction_).norm();
  const double rounding = std::max(position_rounding(start_), position_rounding(point)) / 4;
  if (!(forward > length_) || drift > rounding) return false;
  end_ = point;
  length_ = way.norm();
  direction_ = way / length_;
  drift_ = drift;
  return true;
}

}  // namespace kcs::motion
