// The searches that planning needs: plain, and the same on every machine.
#pragma once

namespace kcs::planning {

// The largest x in [low, high] for which `excess(x)` ≤ 0, from below: to a relative 1e-13, or until what is left unused
// is at most `slack`. `excess` must rise (where it matters, at its zero); that it is ≤ 0 at `low` is taken for granted.
// False position with the Illinois rule, and a halving now and then, so that the number of steps is bounded.
template <class Function>
double largest_fitting(double low, double high, double slack, Function excess) {
  double at_high = excess(high);
  if (at_high <= 0) return high;
  double at_low = excess(low);
  constexpr int kMaxSteps = 200;
  int side = 0;  // which end the last step moved: −1 the low one, +1 the high one
  for (int step = 1; step <= kMaxSteps && high - low > 1e-13 * high; ++step) {
    double x = low + (high - low) / 2;
    if (at_low < 0 && step % 4 != 0) x = low - at_low * ((high - low) / (at_high - at_low));
    if (!(x > low && x < high)) x = low + (high - low) / 2;
    if (x <= low || x >= high) break;
    const double at_x = excess(x);
    if (at_x <= 0) {
      if (-at_x <= slack) return x;
      low = x;
      at_low = at_x;
      if (side < 0) at_high /= 2;
      side = -1;
    } else {
      high = x;
      at_high = at_x;
      if (side > 0) at_low /= 2;
      side = 1;
    }
  }
  return low;
}

// Where `value` is least in [low, high], to a millionth of the interval, if it falls up to some point and rises after
// it (golden section).
template <class Function>
double least_argument(double low, double high, Function value) {
  constexpr double kShare = 0.6180339887498949;
  constexpr int kSteps = 29;  // kShare to this power is less than a millionth
  double left = high - kShare * (high - low), right = low + kShare * (high - low);
  double at_left = value(left), at_right = value(right);
  for (int step = 0; step < kSteps; ++step) {
    if (at_left < at_right) {
      high = right;
      right = left;
      at_right = at_left;
      left = high - kShare * (high - low);
      at_left = value(left);
    } else {
      low = left;
      left = right;
      at_left = at_right;
      right = low + kShare * (high - low);
      at_right = value(right);
    }
  }
  return low + (high - low) / 2;
}

}  // namespace kcs::planning
