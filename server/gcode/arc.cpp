#include "server/gcode/arc.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "server/gcode/trigonometry.h"

namespace kcs::gcode {
namespace {

using Eigen::Vector2d;
using std::numbers::pi;

constexpr double kMaxShortfall = 0.001;  // mm, by which a radius may fail to reach: a program's rounding
// How far a program's rounding may put the two radii of an arc apart, mm.
constexpr double kRounding = 0.005;
constexpr double kMismatch = 0.5;            // mm, between the two radii of an arc
constexpr double kRelativeMismatch = 0.001;  // of the larger one
constexpr double kRefusedMismatch = 0.05;    // likewise
// Points closer than this are the same: floating-point rounding, not the program's, mm.
constexpr double kSamePoint = 1e-8;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// The vector turned by a right angle, counterclockwise.
Vector2d left_of(const Vector2d& v) { return {-v.y(), v.x()}; }

double sign_of(Turn turn) { return turn == Turn::kCounterclockwise ? 1 : -1; }

}  // namespace

Arc::Arc(const Vector& start, const Vector& end, const Vector2d& centre, Plane plane, double sweep)
    : start_(start),
      end_(end),
      centre_(centre),
      plane_(plane),
      sweep_(sweep),
      start_radius_((plane.of(start) - centre).norm()),
      end_radius_((plane.of(end) - centre).norm()) {}

Arc Arc::about_centre(const Vector& start, const Vector& end, const Vector2d& centre, Plane plane, Turn turn, int turns,
                      Place place) {
  const Vector2d from = plane.of(start) - centre;
  const Vector2d to = plane.of(end) - centre;
  const double smaller = std::min(from.norm(), to.norm());
  const double larger = std::max(from.norm(), to.norm());
  if (smaller < kSamePoint) {
    refuse(place,
           "the arc's centre lies on its start or end. Check I, J and K: distances from the start to the centre, "
           "or with G90.1 its coordinates.");
  }
  if (larger - smaller > kRefusedMismatch * larger) {
    refuse(place,
           "the arc's start is " + std::to_string(from.norm()) + " mm from its centre and its end " +
               std::to_string(to.norm()) +
               " mm. Check I, J and K (G91.1: from the start, G90.1: absolute), the plane (G17 to G19), the units.");
  }
  double angle = sign_of(turn) * arc_tangent(cross(from, to), from.dot(to));
  if ((to - from).norm() < kSamePoint) {
    angle = 2 * pi;
  } else if (angle <= 0) {
    angle += 2 * pi;
  }
  return {start, end, centre, plane, sign_of(turn) * (angle + 2 * pi * (turns - 1))};
}

Arc Arc::of_radius(const Vector& start, const Vector& end, double radius, Plane plane, Turn turn, int turns,
                   Place place) {
  const Vector2d span = plane.of(end) - plane.of(start);
  const double half = span.norm() / 2;
  if (2 * half < kSamePoint) {
    refuse(place, "an arc by radius R must end elsewhere than it starts. Write a full circle with I, J or K.");
  }
  if (half > std::abs(radius) + kMaxShortfall) {
    refuse(place, "the arc's end is " + std::to_string(2 * half) +
                      " mm from its start, more than 0.002 mm farther than twice the radius of " +
                      std::to_string(std::abs(radius)) + " mm. Check R and the units.");
  }
  const double reach = std::max(half, std::abs(radius));
  // The centre of a minor counterclockwise arc lies to the left of the span.
  const double side = sign_of(turn) * (radius > 0 ? 1 : -1);
  const double height = std::sqrt((reach - half) * (reach + half));
  const double minor_angle = 2 * arc_tangent(half, height);
  const Vector2d centre = plane.of(start) + span / 2 + side * height / (2 * half) * left_of(span);
  const double angle = radius > 0 ? minor_angle : 2 * pi - minor_angle;
  return {start, end, centre, plane, sign_of(turn) * (angle + 2 * pi * (turns - 1))};
}

double Arc::length() const {
  return Vector(mean_radius() * sweep_, end_radius_ - start_radius_, end_[plane_.normal] - start_[plane_.normal])
      .norm();
}

// The second derivative of the arc by its angle bounds the distance to a chord over an angle a: at most a²/8 of it.
// For a circle it is the radius.
double Arc::curvature_reach() const {
  return Vector2d(std::max(start_radius_, end_radius_), 2 * (end_radius_ - start_radius_) / sweep_).norm();
}

double Arc::chords_within(double tolerance) const {
  const double angle = std::min(std::sqrt(8 * tolerance / curvature_reach()), pi / 2);
  return std::ceil(sweep() / angle);
}

double Arc::chord_error(double chords) const {
  const double sine = sine_and_cosine(sweep() / chords / 4).sine;
  return 2 * curvature_reach() * sine * sine;
}

Vector Arc::chord_end(std::size_t index, std::size_t chords) const {
  if (index == chords) return end_;
  const double share = static_cast<double>(index) / static_cast<double>(chords);
  const auto [sine, cosine] = sine_and_cosine(share * sweep_);
  const double scale = 1 + share * (end_radius_ / start_radius_ - 1);
  const Vector2d from = scale * (plane_.of(start_) - centre_);
  const Vector2d point = centre_ + cosine * from + sine * left_of(from);
  Vector end;
  end[plane_.first] = point.x();
  end[plane_.second] = point.y();
  end[plane_.normal] = start_[plane_.normal] + share * (end_[plane_.normal] - start_[plane_.normal]);
  return end;
}

bool Arc::has_mismatch() const {
  const double mismatch = std::abs(end_radius_ - start_radius_);
  const double larger = std::max(start_radius_, end_radius_);
  return mismatch > kMismatch || (mismatch > kRounding && mismatch > kRelativeMismatch * larger);
}

double Arc::reach() const { return centre_.cwiseAbs().maxCoeff() + std::max(start_radius_, end_radius_); }

}  // namespace kcs::gcode
