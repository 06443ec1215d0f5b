#include "server/planning/motion_shares.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "server/motion/contour.h"
#include "server/motion/going_back.h"
#include "server/motion/mitres.h"
#include "server/planning/stopped.h"

namespace kcs::planning {
namespace {

// Between two points whose shares are no more than this, there is no need to look.
constexpr double kWellWithin = 0.1;
// From this share on a corner is too far away.
constexpr double kCut = 0.8;
// The point that was drawn to a corner stays the one, unless another is nearer than this share of its distance: each
// change of points upsets the motion around.
constexpr double kLoyalty = 0.3;
// Two ways are the same if they differ by less than this share of the tolerance.
constexpr double kSame = 1e-6;

// A change of feed may take this much more than the least limits of the axes: it only warns, and what is too much the
// search will find. Less costs cycle time, more costs rounds.
constexpr double kHurry = 3;

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
  const std::size_t first = std::max<std::size_t>(k, 3) - 3, last = std::min(spline.points.size() - 3, k + 3);
  Vector from = spline.knot(first) - point;
  for (std::size_t m = first + 1; m <= last; ++m) {
    const Vector to = spline.knot(m) - point, chord = to - from;
    const double length = chord.squaredNorm();
    const double share = length > 0 ? std::min(std::max(-from.dot(chord) / length, 0.0), 1.0) : 0;
    nearest = std::min(nearest, (from + share * chord).squaredNorm());
    from = to;
  }
  return std::sqrt(nearest);
}

// What makes shares of differences of points: one over the limit, in units of the step of time; 0 for an axis that is
// none.
Vector per_limit(const motion::AxisLimits& limits, const Vector& limit, double step) {
  Vector result = Vector::Zero();
  for (std::size_t axis = 0; axis < limits.axes; ++axis) result[axis] = 1 / (limit[axis] * step);
  return result;
}

double share_of(const Vector& difference, const Vector& per_limit) {
  return difference.cwiseProduct(per_limit).cwiseAbs().maxCoeff();
}

}  // namespace

void MotionShares::begin(const StretchPath& path, std::span<const StretchPiece> settled, const std::stop_token& stop) {
  stop_ = stop;
  first_corner_ = 0;
  reached_.assign(path.legs().size(), false);
  for (const StretchPiece& piece : settled) {
    pass_corners(path, piece.phase, piece.first_leg, piece.last_leg);
  }
  while (reached_[first_corner_]) ++first_corner_;  // nothing comes near to the end of the last leg
}

void MotionShares::measure(const StretchPath& path, const motion::AxisLimits& limits, TimeSpline& spline,
                           std::vector<std::size_t>& legs, bool closely) {
  measure_places(path, spline, legs, closely);
  measure_corners(path, spline);
  largest_place_ = *std::max_element(place_.begin(), place_.end());
  measure_limits(path, limits, spline);
  measure_haste(limits, spline);
}

void MotionShares::raise(std::size_t from, std::size_t count, double share) {
  for (std::size_t i = from; i < std::min(place_.size(), from + count); ++i) place_[i] = std::max(place_[i], share);
}

void MotionShares::measure_places(const StretchPath& path, TimeSpline& spline, std::vector<std::size_t>& legs,
                                  bool closely) {
  const auto& points = spline.points;
  const std::size_t size = points.size();
  place_.resize(size);
  drawn_to_ = spline.ways;
  place_[0] = place_[size - 1] = 0;
  const auto measure = [&](const Vector& point, std::size_t leg) {
    const Projection at = path.project(point, leg);
    return std::pair(at, path.share_of_tolerance(at));
  };
  double share_before = 0;
  for (std::size_t i = 1; i + 1 < size; ++i) {
    throw_if_stopped(stop_);
    const auto [at, share] = measure((1.0 / 6) * (points[i - 1] + points[i + 1]) + (4.0 / 6) * points[i], legs[i]);
    if (i >= 3 && i + 3 < size) {
      spline.ways[i] = std::clamp(at.way, spline.ways[i - 1], std::max(spline.ways[i - 1], spline.ways[size - 3]));
      legs[i] = at.leg;
    }
    place_[i] = share;
    if (closely && i > 1 && std::max(share_before, share) > kWellWithin) {
      const Vector middle = (1.0 / 48) * (points[i - 2] + points[i + 1]) + (23.0 / 48) * (points[i - 1] + points[i]);
      const double between = measure(middle, legs[i - 1]).second;
      place_[i - 1] = std::max(place_[i - 1], between);
      place_[i] = std::max(share, between);
    }
    share_before = share;
  }
}

// Where the motion does not come near enough to a sharp corner, a point is drawn to the corner itself: the places that
// are nearest to the curve would leave it out for ever.
void MotionShares::measure_corners(const StretchPath& path, TimeSpline& spline) {
  const auto legs = path.legs();
  const auto& ways = spline.ways;
  std::size_t k = 1;
  for (std::size_t i = first_corner_; i + 1 < legs.size() && path.way(i + 1) < ways[ways.size() - 2]; ++i) {
    if (!path.may_be_missed(i)) continue;
    while (k + 3 < ways.size() && ways[k + 1] < path.way(i + 1)) ++k;
    const double share = distance_near(spline, k, path.corners()[i + 1]) / path.reach(i);
    raise(k - 1, 3, share);
    if (share < kCut) continue;
    const auto away = [&](std::size_t point) {
      const bool was_drawn = std::abs(drawn_to_[point] - path.way(i + 1)) <= kSame * path.tolerance();
      return (was_drawn ? kLoyalty : 1) * std::abs(ways[point] - path.way(i + 1));
    };
    const std::size_t drawn = away(k) < away(k + 1) ? k : k + 1;
    if (drawn > 2 && drawn + 3 < ways.size()) spline.ways[drawn] = path.way(i + 1);
  }
}

void MotionShares::measure_limits(const StretchPath& path, const motion::AxisLimits& limits, const TimeSpline& spline) {
  const auto& points = spline.points;
  const std::size_t size = points.size();
  speed_.resize(size - 1);
  feeds_.resize(size - 1);
  acceleration_.resize(size - 2);
  jerk_.resize(size - 3);
  axis_jerk_.resize(size - 3);
  const double step = spline.step;
  const Vector per_velocity = per_limit(limits, limits.velocity, step),
               per_acceleration = per_limit(limits, limits.acceleration, step * step),
               per_jerk = per_limit(limits, limits.jerk, step * step * step);
  Vector first_before = Vector::Zero(), second_before = Vector::Zero();
  for (std::size_t j = 0; j + 1 < size; ++j) {
    const Vector first = points[j + 1] - points[j], second = first - first_before;
    // Of all pieces that it is part of.
    const double feed = feeds_[j] =
        path.feed_between(spline.ways[std::max<std::size_t>(j, 1) - 1], spline.ways[std::min(size - 1, j + 2)]);
    speed_[j] = std::max(first.norm() / (feed * step), share_of(first, per_velocity));
    if (j > 0) acceleration_[j - 1] = share_of(second, per_acceleration);
    if (j > 1) {
      axis_jerk_[j - 2] = (second - second_before).cwiseProduct(per_jerk).cwiseAbs();
      jerk_[j - 2] = axis_jerk_[j - 2].maxCoeff();
    }
    first_before = first;
    second_before = second;
  }
}

// Speed falls in no time only on paper: around a lower feed, the tool can be as much faster as the axes' least limits
// let it become in the time between.
void MotionShares::measure_haste(const motion::AxisLimits& limits, const TimeSpline& spline) {
  haste_ = speed_;
  const auto axes = static_cast<Eigen::Index>(limits.axes);
  const double acceleration = kHurry * limits.acceleration.head(axes).minCoeff();
  const double jerk = kHurry * limits.jerk.head(axes).minCoeff();
  const double ramp = acceleration / jerk;
  const auto change = [&](double time) {  // from one steady speed to another
    return time < 2 * ramp ? jerk * time * time / 4 : acceleration * (time - ramp);
  };
  for (std::size_t j = 0; j + 1 < feeds_.size(); ++j) {
    if (feeds_[j] == feeds_[j + 1]) continue;
    throw_if_stopped(stop_);
    const double low = std::min(feeds_[j], feeds_[j + 1]);
    const bool rises = feeds_[j] == low;
    for (std::size_t n = 1; rises ? j + n < feeds_.size() : n <= j + 1; ++n) {
      const std::size_t i = rises ? j + n : j + 1 - n;
      const double reached = low + change(static_cast<double>(n) * spline.step);
      if (reached >= feeds_[i]) break;
      haste_[i] = std::max(haste_[i], spline.velocity(i).norm() / reached);
    }
  }
}

double MotionShares::slower() const {
  const auto largest = [](const std::vector<double>& shares) {
    return *std::max_element(shares.begin(), shares.end());
  };
  return std::max({largest(speed_), std::sqrt(largest(acceleration_)), std::cbrt(largest(jerk_))});
}

bool MotionShares::verify_places(const StretchPath& path, const motion::AxisLimits& limits, const TimeSpline& spline) {
  reached_.assign(path.legs().size(), false);
  bool well = true;
  std::pair<std::size_t, std::size_t> legs;
  for (std::size_t j = 0; j < spline.pieces(); ++j) {
    legs = path.legs_between(spline.ways[j + 1], spline.ways[j + 2], legs.first);
    well &= verify_piece(path, limits, spline, j, legs);
  }
  return verify_corners(path, spline) && well;
}

bool MotionShares::verify_piece(const StretchPath& path, const motion::AxisLimits& limits, const TimeSpline& spline,
                                std::size_t piece, const std::pair<std::size_t, std::size_t>& followed) {
  const auto [first, last] = followed;
  const auto legs = path.legs().subspan(first, last - first + 1);
  const motion::Phase phase = spline.phase(piece, Vector::Zero());
  double tolerance = legs[0].tolerance;
  for (const Leg& leg : legs) tolerance = std::min(tolerance, leg.tolerance);
  bool well = true;
  const auto pieces = path.pieces().subspan(first, legs.size());
  motion::pass_mitres(phase, pieces, mitres_);
  const double error = motion::largest_contour_error(phase, pieces, mitres_, kErrorResolution * tolerance,
                                                     (1 - kErrorResolution) * tolerance);
  if (!(error <= tolerance)) {
    well = false;
    raise(piece + 1, 2, kEmphasis * error / tolerance);
  }
  const double standing = kStanding * limits.velocity.maxCoeff();
  if (motion::speed_back(phase, phase.at(phase.duration), pieces, standing) > 0) {
    well = false;
    raise(piece + 1, 2, kGoesBack);
  }
  pass_corners(path, phase, std::max(first, first_corner_), last);
  return well;
}

// Between the first and the last leg.
void MotionShares::pass_corners(const StretchPath& path, const motion::Phase& phase, std::size_t first,
                                std::size_t last) {
  throw_if_stopped(stop_);
  const auto curve = motion::Curve::between(phase.start, phase.at(phase.duration), phase.duration);
  for (std::size_t i = first; i < last; ++i) {
    if (!reached_[i]) reached_[i] = motion::comes_within(curve, path.corners()[i + 1], path.reach(i));
  }
}

bool MotionShares::verify_corners(const StretchPath& path, const TimeSpline& spline) {
  const auto& ways = spline.ways;
  bool well = true;
  std::size_t k = 1;
  for (std::size_t i = first_corner_; i + 1 < path.legs().size() && path.way(i + 1) < ways[ways.size() - 2]; ++i) {
    if (reached_[i]) continue;
    well = false;
    while (k + 2 < ways.size() && ways[k + 1] < path.way(i + 1)) ++k;
    raise(k, 2, kEmphasis * std::max(1.0, distance_near(spline, k, path.corners()[i + 1]) / path.reach(i)));
  }
  return well;
}

}  // namespace kcs::planning
