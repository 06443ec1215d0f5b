#include "server/motion/polynomial.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kcs::motion {
namespace {

using Coefficients = std::array<double, 4>;

double value(const Coefficients& c, double t) { return c[0] + t * (c[1] + t * (c[2] + t * c[3])); }

}  // namespace

double root_between(const Coefficients& c, double low, double high) {
  const double at_low = value(c, low), at_high = value(c, high);
  const double resolution = std::numeric_limits<double>::epsilon() * high;
  double width = high - low;
  double root = low + width * (at_low / (at_low - at_high));
  if (!(root > low && root < high)) root = low + width / 2;
  while (true) {
    const double error = value(c, root);
    if (error == 0) return root;
    ((error < 0) == (at_low < 0) ? low : high) = root;
    // Newton's step where it stays inside and converges, a halving where it does not.
    double next = root - error / (c[1] + root * (2 * c[2] + root * 3 * c[3]));
    const bool inside = next > low && next < high;
    if (!inside || std::abs(next - root) > width / 2) next = low + (high - low) / 2;
    width = std::abs(next - root);
    if (width <= resolution) return next;
    root = next;
  }
}

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
    if ((low < 0 && high > 0) || (low > 0 && high < 0)) roots.add(root_between(c, stops[i], stops[i + 1]));
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
