#include "server/planning/motion_shares.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "server/motion/contour.h"

namespace kcs::planning {
namespace {

// Corners that turn less, as |D|, are passed near enough if the tolerance is kept.
constexpr double kSharp = 0.3;
// From this share on a corner is too far away.
constexpr double kCut = 0.8;

// How precisely a contour error is known, as a share of the tolerance.
constexpr double kErrorResolution = 1e-4;
// What the verifier finds outside is made this much worse, so that it is felt.
constexpr double kEmphasis = 1.1;
constexpr double kGoesBack = 1.5;
// A tool that goes back by less than this share of an axis' speed stands.
constexpr double kStanding = 1e-10;

// From a point to the spline around the control point k, mm: to the chords between its knots.
double distance_near(const TimeSpline& spline, std::size_t k, const Vector& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t m = std::max<std::size_t>(k, 3) - 2; m <= std::min(spline.points.size() - 3, k + 3); ++m) {
    nearest = std::min(nearest, motion::distance_to_segment(point, spline.knot(m - 1), spline.knot(m)));
  }
  return nearest;
}

double share_of(const Vector& value, const motion::AxisLimits& limits, const Vector& limit) {
  double result = 0;
  for (std::size_t axis = 0; axis < limits.axes; ++axis) {
    result = std::max(result, std::abs(value[axis]) / limit[axis]);
  }
  return result;
}

}  // namespace

void MotionShares::measure(const StretchPath& path, const motion::AxisLimits& limits, TimeSpline& spline,
                           std::vector<std::size_t>& legs) {
  measure_places(path, spline, legs);
  measure_corners(path, spline);
  largest_place_ = *std::max_element(place_.begin(), place_.end());
  measure_limits(path, limits, spline);
}

void MotionShares::raise(std::size_t from, std::size_t count, double share) {
  for (std::size_t i = from; i < std::min(place_.size(), from + count); ++i) place_[i] = std::max(place_[i], share);
}

void MotionShares::measure_places(const StretchPath& path, TimeSpline& spline, std::vector<std::size_t>& legs) {
  const auto& points = spline.points;
  const std::size_t size = points.size();
  place_.assign(size, 0);
  for (std::size_t i = 1; i + 1 < size; ++i) {
    const Projection at = path.project(spline.knot(i - 1), legs[i]);
    raise(i, 1, at.distance / path.legs()[at.leg].tolerance);
    if (i < 3 || i + 3 >= size) continue;
    spline.ways[i] = std::clamp(at.way, spline.ways[i - 1], std::max(spline.ways[i - 1], spline.ways[size - 3]));
    legs[i] = at.leg;
  }
  for (std::size_t i = 1; i + 2 < size; ++i) {
    const Vector middle = (points[i - 1] + 23 * points[i] + 23 * points[i + 1] + points[i + 2]) / 48;
    const Projection at = path.project(middle, legs[i]);
    raise(i, 2, at.distance / path.legs()[at.leg].tolerance);
  }
}

// Where the motion does not come near enough to a sharp corner, a point is drawn to the corner itself: the places that
// are nearest to the curve would leave it out for ever.
void MotionShares::measure_corners(const StretchPath& path, TimeSpline& spline) {
  const auto legs = path.legs();
  const auto& ways = spline.ways;
  std::size_t k = 1;
  for (std::size_t i = path.leg_at(ways[1]); i + 1 < legs.size() && path.way(i + 1) < ways[ways.size() - 2]; ++i) {
    if ((legs[i + 1].direction - legs[i].direction).squaredNorm() < kSharp * kSharp) continue;
    while (k + 3 < ways.size() && ways[k + 1] < path.way(i + 1)) ++k;
    const double share = distance_near(spline, k, path.corners()[i + 1]) / path.reach(i);
    raise(k - 1, 3, share);
    if (share < kCut) continue;
    const std::size_t drawn = path.way(i + 1) - ways[k] < ways[k + 1] - path.way(i + 1) ? k : k + 1;
    if (drawn > 2 && drawn + 3 < ways.size()) spline.ways[drawn] = path.way(i + 1);
  }
}

void MotionShares::measure_limits(const StretchPath& path, const motion::AxisLimits& limits, const TimeSpline& spline) {
  const std::size_t size = spline.points.size();
  speed_.resize(size - 1);
  acceleration_.resize(size - 2);
  jerk_.resize(size - 3);
  Vector velocity_before = Vector::Zero(), acceleration_before = Vector::Zero();
  for (std::size_t j = 0; j + 1 < size; ++j) {
    const Vector velocity = spline.velocity(j);
    // Of all pieces that it is part of.
    const double feed =
        path.feed_between(spline.ways[std::max<std::size_t>(j, 2) - 2], spline.ways[std::min(size - 1, j + 3)]);
    speed_[j] = std::max(velocity.norm() / feed, share_of(velocity, limits, limits.velocity));
    const Vector acceleration = (velocity - velocity_before) / spline.step;
    if (j > 0) acceleration_[j - 1] = share_of(acceleration, limits, limits.acceleration);
    if (j > 1) jerk_[j - 2] = share_of((acceleration - acceleration_before) / spline.step, limits, limits.jerk);
    velocity_before = velocity;
    acceleration_before = acceleration;
  }
}

double MotionShares::slower() const {
  const auto largest = [](const std::vector<double>& shares) {
    return *std::max_element(shares.begin(), shares.end());
  };
  return std::max({largest(speed_), std::sqrt(largest(acceleration_)), std::cbrt(largest(jerk_))});
}

bool MotionShares::verify_places(const StretchPath& path, const motion::AxisLimits& limits, const TimeSpline& spline) {
  first_corner_ = path.leg_at(spline.ways[0]);
  reached_.assign(path.leg_at(spline.ways.back(), first_corner_) - first_corner_ + 1, false);
  bool well = true;
  for (std::size_t j = 0; j < spline.pieces(); ++j) well &= verify_piece(path, limits, spline, j);
  return verify_corners(path, spline) && well;
}

bool MotionShares::verify_piece(const StretchPath& path, const motion::AxisLimits& limits, const TimeSpline& spline,
                                std::size_t piece) {
  const auto [first, last] = path.legs_between(spline.ways[piece], spline.ways[piece + 3]);
  const auto legs = path.legs().subspan(first, last - first + 1);
  const motion::Phase phase = spline.phase(piece, Vector::Zero());
  double tolerance = legs[0].tolerance;
  for (const Leg& leg : legs) tolerance = std::min(tolerance, leg.tolerance);
  bool well = true;
  const double error = motion::largest_contour_error(phase, path.pieces().subspan(first, legs.size()),
                                                     kErrorResolution * tolerance, (1 - kErrorResolution) * tolerance);
  if (!(error <= tolerance)) {
    well = false;
    raise(piece + 1, 2, kEmphasis * error / tolerance);
  }
  for (std::size_t k = piece; k < piece + 3; ++k) {
    const Vector velocity = spline.velocity(k);
    if (legs.size() > 1 || velocity.dot(legs[0].direction) >= -kStanding * limits.velocity.maxCoeff()) continue;
    well = false;
    raise(k, 2, kGoesBack);
  }
  const auto curve = motion::Curve::between(phase.start, phase.at(phase.duration), phase.duration);
  for (std::size_t i = std::max(first, first_corner_); i < std::min(last, first_corner_ + reached_.size()); ++i) {
    auto reached = reached_[i - first_corner_];
    if (!reached) reached = motion::comes_within(curve, path.corners()[i + 1], path.reach(i));
  }
  return well;
}

bool MotionShares::verify_corners(const StretchPath& path, const TimeSpline& spline) {
  const auto& ways = spline.ways;
  bool well = true;
  std::size_t k = 1;
  for (std::size_t n = 0; n < reached_.size(); ++n) {
    const std::size_t i = first_corner_ + n;
    if (i + 1 >= path.legs().size() || path.way(i + 1) <= ways[1] || path.way(i + 1) >= ways[ways.size() - 2]) continue;
    if (reached_[n]) continue;
    well = false;
    while (k + 2 < ways.size() && ways[k + 1] < path.way(i + 1)) ++k;
    raise(k, 2, kEmphasis * std::max(1.0, distance_near(spline, k, path.corners()[i + 1]) / path.reach(i)));
  }
  return well;
}

}  // namespace kcs::planning
