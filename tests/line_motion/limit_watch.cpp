#include "tests/line_motion/limit_watch.h"

#include <algorithm>
#include <cmath>

namespace kcs::test {

void LimitWatch::see(const double* command_mm) {
  const double h = profile_.period_s;
  for (unsigned axis = 0; axis < profile_.axes; ++axis) {
    const double p = command_mm[axis];
    if (!began_) {
      for (auto& before : before_) before[axis] = p;
    }
    const double a = before_[0][axis];
    const double b = before_[1][axis];
    const double c = before_[2][axis];
    const double shares[] = {std::abs(p - a) / (profile_.velocity_mm_s[axis] * h),
                             std::abs(p - 2 * a + b) / (profile_.acceleration_mm_s2[axis] * h * h),
                             std::abs(p - 3 * a + 3 * b - c) / (profile_.jerk_mm_s3[axis] * h * h * h)};
    largest_ = std::max({largest_, shares[0], shares[1], shares[2]});
    before_[2][axis] = b;
    before_[1][axis] = a;
    before_[0][axis] = p;
  }
  began_ = true;
}

}  // namespace kcs::test
