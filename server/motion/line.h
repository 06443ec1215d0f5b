// A straight line between two points.
#pragma once

#include <cmath>

#include "server/motion/phase.h"

namespace kcs::motion {

class Line {
 public:
  Line(const Vector& from, const Vector& to)
      : from_(from),
        to_(to),
        length_((to - from).norm()),
        direction_(length_ > 0 ? Vector((to - from) / length_) : Vector::Zero()) {}

  const Vector& from() const { return from_; }            // mm
  const Vector& to() const { return to_; }                // mm
  double length() const { return length_; }               // mm
  const Vector& direction() const { return direction_; }  // unit tangent; zero for a line of no length

  // Square of the distance from a point to the nearest place between the line's ends, mm².
  double square_distance(const Vector& point) const {
    const Vector way = point - from_;
    const double forward = way.dot(direction_);
    if (!(forward > 0)) return way.squaredNorm();
    // From the nearer end: a long line does not lose digits.
    if (forward <= length_ / 2) return (way - forward * direction_).squaredNorm();
    const Vector back = point - to_;
    const double beyond = back.dot(direction_);
    return (beyond < 0 ? Vector(back - beyond * direction_) : back).squaredNorm();
  }

 private:
  Vector from_, to_;
  double length_;
  Vector direction_;
};

// Distance from a point to the segment between two points, mm.
inline double distance_to_segment(const Vector& point, const Vector& from, const Vector& to) {
  return std::sqrt(Line(from, to).square_distance(point));
}

}  // namespace kcs::motion
