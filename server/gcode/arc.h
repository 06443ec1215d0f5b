// Arcs and helices: their shape, and the chords that stand for them.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>

#include "server/gcode/place.h"
#include "server/planning/toolpath.h"

namespace kcs::gcode {

using planning::Vector;

// The plane of an arc: its first and second axis (0 is X) and the one normal to it, right-handed. Clockwise is as seen
// by someone who looks against the normal axis.
struct Plane {
  int first = 0;
  int second = 1;
  int normal = 2;

  Eigen::Vector2d of(const Vector& point) const { return {point[first], point[second]}; }
};
inline constexpr Plane kPlaneXy{0, 1, 2};  // G17
inline constexpr Plane kPlaneZx{2, 0, 1};  // G18
inline constexpr Plane kPlaneYz{1, 2, 0};  // G19

enum class Turn { kClockwise, kCounterclockwise };

// A circular arc in a plane, with a steady move along the normal axis if `start` and `end` differ there (a helix).
// Where the end is not as far from the centre as the start, the radius changes steadily (a spiral).
class Arc {
 public:
  // An arc about `centre`, through `turns` − 1 full circles and on to the end; a full circle more if the end lies on
  // the start. turns ≥ 1. Refuses, naming `place`, a centre on an end of the arc, and ends whose distances from the
  // centre differ by more than 5 %.
  static Arc about_centre(const Vector& start, const Vector& end, const Eigen::Vector2d& centre, Plane plane, Turn turn,
                          int turns, Place place);

  // An arc of a given radius: the one below 180° if radius > 0, the one above if radius < 0. Refuses, naming `place`,
  // an end on the start, and a radius that does not reach the end: below half the distance of the two by more than
  // 0.001 mm. By less, which is rounding, that half becomes the radius.
  static Arc of_radius(const Vector& start, const Vector& end, double radius, Plane plane, Turn turn, int turns,
                       Place place);

  // mm along the arc.
  double length() const;

  // The number of equal chords whose distance from the arc is at most `tolerance` (mm, > 0); at least four a circle.
  // A double, for it may be more than can be counted.
  double chords_within(double tolerance) const;
  // The largest distance between the arc and `chords` equal chords, mm.
  double chord_error(double chords) const;
  // The end of chord `index` of `chords`, index from 1. That of the last is the arc's end exactly.
  Vector chord_end(std::size_t index, std::size_t chords) const;

  // Distances of the start and the end from the centre, in the plane, mm.
  double start_radius() const { return start_radius_; }
  double end_radius() const { return end_radius_; }
  // The two differ by more than a program's rounding explains: by more than 0.5 mm, or by more than 0.005 mm and 0.1 %
  // of the larger one. Machines refuse such an arc.
  bool has_mismatch() const;

  // Magnitude of the whole turn, rad.
  double sweep() const { return std::abs(sweep_); }
  const Vector& end() const { return end_; }
  // The largest coordinate, in magnitude, of the whole circle, mm.
  double reach() const;

 private:
  Arc(const Vector& start, const Vector& end, const Eigen::Vector2d& centre, Plane plane, double sweep);

  double mean_radius() const { return (start_radius_ + end_radius_) / 2; }
  double curvature_reach() const;

  Vector start_;
  Vector end_;
  Eigen::Vector2d centre_;
  Plane plane_;
  double sweep_;  // rad, > 0 counterclockwise
  double start_radius_;
  double end_radius_;
};

}  // namespace kcs::gcode
