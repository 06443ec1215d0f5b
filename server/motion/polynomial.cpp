#include "server/motion/polynomial.h"

#include <algorithm>
#include <cmath>

namespace kcs::motion {
namespace {

using Coefficients = std::array<double, 4>;

double value(const Coefficients& c, double t) { return c[0] + t * (c[1] + t * (c[2] + t * c[3])); }

// The root between `low` and `high`, where the signs differ: halving until the doubles are used up.
double bisect(const Coefficients& c, double low, double high) {
  const bool rising = value(c, low) < 0;
  while (true) {
    const double middle = low + (high - low) / 2;
    if (middle <= low || middle >= high) return middle;
    ((value(c, middle) < 0) == rising ? low : high) = middle;
  }
}

}  // namespace

Roots sign_changes(const Coefficients& c, double end) {
  // Between two neighbouring extremes the polynomial is monotone and changes its sign at most once.
  std::array<double, 4> stops{0, end, end, end};
  std::size_t stop_count = 1;
  const double a = 3 * c[3], b = 2 * c[2];
  const double discriminant = b * b - 4 * a * c[1];
  if (discriminant >= 0) {
    // Both roots of the derivative without cancellation.
    const double q = -(b + std::copysign(std::sqrt(discriminant), b)) / 2;
    std::array<double, 2> extremes{q != 0 ? c[1] / q : 0, a != 0 ? q / a : 0};
    std::sort(extremes.begin(), extremes.end());
    for (const double t : extremes) {
      if (t > stops[stop_count - 1] && t < end) stops[stop_count++] = t;
    }
  }
  stops[stop_count++] = end;

  Roots roots;
  for (std::size_t i = 0; i + 1 < stop_count; ++i) {
    const double low = value(c, stops[i]), high = value(c, stops[i + 1]);
    if ((low < 0 && high > 0) || (low > 0 && high < 0)) roots.add(bisect(c, stops[i], stops[i + 1]));
  }
  return roots;
}

Vector largest_velocity(const Phase& phase) {
  Vector largest = phase.start.velocity.cwiseAbs().cwiseMax(phase.at(phase.duration).velocity.cwiseAbs());
  for (int axis = 0; axis < 3; ++axis) {
    if (phase.jerk[axis] == 0) continue;
    const double turn = -phase.start.acceleration[axis] / phase.jerk[axis];
    if (turn > 0 && turn < phase.duration) {
      largest[axis] = std::max(largest[axis], std::abs(phase.at(turn).velocity[axis]));
    }
  }
  return largest;
}

Vector largest_acceleration(const Phase& phase) {
  return phase.start.acceleration.cwiseAbs().cwiseMax(phase.at(phase.duration).acceleration.cwiseAbs());
}

double largest_speed(const Phase& phase) {
  const Vector& v = phase.start.velocity;
  const Vector& a = phase.start.acceleration;
  const Vector& j = phase.jerk;
  double largest = std::max(v.norm(), phase.at(phase.duration).velocity.norm());
  // The middle Bézier point of the velocity bounds what lies between the ends; mostly there is nothing more to find.
  if ((v + a * (phase.duration / 2)).norm() <= largest) return largest;
  // The speed is extreme where velocity · acceleration = 0.
  for (const double t : sign_changes({v.dot(a), a.dot(a) + v.dot(j), 1.5 * a.dot(j), 0.5 * j.dot(j)}, phase.duration)) {
    largest = std::max(largest, phase.at(t).velocity.norm());
  }
  return largest;
}

}  // namespace kcs::motion
