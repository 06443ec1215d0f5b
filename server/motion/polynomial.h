// Roots and extremes of the low polynomials that constant-jerk motion is made of.
#pragma once

#include <array>
#include <cstddef>

#include "server/motion/phase.h"

namespace kcs::motion {

// Up to three roots, in rising order.
struct Roots {
  std::array<double, 3> values{};
  std::size_t count = 0;

  void add(double root) { values[count++] = root; }
  const double* begin() const { return values.data(); }
  const double* end() const { return values.data() + count; }
};

// The root of a polynomial c0 + c1 t + c2 t² + c3 t³ between `low` and `high`, 0 ≤ low < high, where its signs differ,
// to the last bit or two of `high`.
double root_between(const std::array<double, 4>& coefficients, double low, double high);

// The roots of c0 + c1 t + c2 t² + c3 t³ in the open interval (0, end) at which the sign changes, to the last bit
// or two of `end`.
Roots sign_changes(const std::array<double, 4>& coefficients, double end);

// Largest magnitude of each axis' velocity during the phase, mm/s.
Vector largest_velocity(const Phase& phase);

// Largest magnitude of each axis' acceleration during the phase, mm/s².
Vector largest_acceleration(const Phase& phase);

// Largest speed along the path during the phase, mm/s.
double largest_speed(const Phase& phase);

}  // namespace kcs::motion
