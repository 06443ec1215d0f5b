// The searches that planning needs: plain, and the same on every machine.
#pragma once

namespace kcs::planning {

// The largest x in [low, high] for which `holds(x)`, to a relative 1e-13 of x or 1e-18 of `high`, from below. `holds`
// must be true up to some point and false after it; it is taken for granted at `low`.
template <class Predicate>
double largest_true(double low, double high, Predicate holds) {
  if (holds(high)) return high;
  const double smallest_step = 1e-18 * high;
  while (high - low > 1e-13 * high && high - low > smallest_step) {
    const double middle = low + (high - low) / 2;
    if (middle <= low || middle >= high) break;
    (holds(middle) ? low : high) = middle;
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
