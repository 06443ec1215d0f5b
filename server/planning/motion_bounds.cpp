#include "server/planning/motion_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "server/planning/search.h"

namespace kcs::planning {
namespace {

// Of each limit so much is taken: what is fitted keeps it nearly, and must keep it in the end.
constexpr double kShareOfLimits = 0.9985;

// Less than this share of a limit now will not become more than all of it: it is left out, for less work.
constexpr double kNear = 0.75;

// So many steps before and after it is nearest to a corner, the tool is looked at as well: it turns most there.
constexpr std::array<double, 2> kBesideCorner{0.35, 0.7};

double square(double value) { return value * value; }
double cube(double value) { return value * value * value; }

PointSum first_difference(std::size_t j) { return {j, 2, {-1, 1}}; }
PointSum second_difference(std::size_t j) { return {j, 3, {1, -2, 1}}; }
PointSum third_difference(std::size_t j) { return {j, 4, {-1, 3, -3, 1}}; }
PointSum knot(std::size_t j) { return {j, 3, {1.0 / 6, 4.0 / 6, 1.0 / 6}}; }

// The place at a time in steps, from the start of piece 0 on.
PointSum place_at(double time, std::size_t pieces) {
  const double inside = std::clamp(time, 0.0, static_cast<double>(pieces));
  const std::size_t piece = std::min(static_cast<std::size_t>(inside), pieces - 1);
  const double u = inside - static_cast<double>(piece), v = 1 - u;
  return {piece,
          4,
          {cube(v) / 6, (3 * cube(u) - 6 * square(u) + 4) / 6, (3 * cube(v) - 6 * square(v) + 4) / 6, cube(u) / 6}};
}

Vector share_of(const Vector& limit, double unit, std::size_t axes) {
  Vector result = Vector::Constant(std::numeric_limits<double>::infinity());
  for (std::size_t axis = 0; axis < axes; ++axis) result[axis] = kShareOfLimits * unit * limit[axis];
  return result;
}

double largest_share(const Vector& value, const Vector& limit) {
  return value.cwiseQuotient(limit).cwiseAbs().maxCoeff();
}

void bound_limits(const StretchPath& path, const motion::AxisLimits& limits, const TimeSpline& spline,
                  QuickestFit& fit) {
  using Kind = QuickestFit::Kind;
  const std::size_t size = spline.points.size();
  const double step = spline.step;
  const Vector speed = share_of(limits.velocity, step, limits.axes),
               acceleration = share_of(limits.acceleration, square(step), limits.axes),
               jerk = share_of(limits.jerk, cube(step), limits.axes);
  for (std::size_t j = 0; j + 3 < size; ++j) fit.limit_axes(third_difference(j), jerk, Kind::kJerk);
  for (std::size_t j = 0; j + 2 < size; ++j) {
    const PointSum change = second_difference(j);
    if (largest_share(change.of(spline.points), acceleration) < kNear) continue;
    fit.limit_axes(change, acceleration, Kind::kAcceleration);
  }
  for (std::size_t j = 0; j + 1 < size; ++j) {
    const PointSum move = first_difference(j);
    const double feed =
        kShareOfLimits * step *
        path.feed_between(spline.ways[std::max<std::size_t>(j, 1) - 1], spline.ways[std::min(size - 1, j + 2)]);
    const Vector moved = move.of(spline.points);
    if (moved.norm() >= kNear * feed) fit.limit_speed(move, feed);
    if (largest_share(moved, speed) >= kNear) fit.limit_axes(move, speed, Kind::kSpeed);
  }
}

// Which leg the tool follows at each knot. Where it passes corners, it is told when it is nearest to them.
class Following {
 public:
  Following(const StretchPath& path, const TimeSpline& spline) : path_(path), spline_(spline) {
    std::size_t leg = path.leg_at(spline.ways[1]);
    for (std::size_t j = 0; j <= spline.pieces(); ++j) {
      leg = std::max(leg, path.project(spline.knot(j), leg).leg);
      legs_.push_back(leg);
    }
  }

  // Calls pass(leg, time) for each leg that the tool leaves, with the time in steps at which it is nearest to its end.
  // Legs then follow from that.
  template <class Pass>
  void pass_corners(Pass pass) {
    std::size_t next = legs_.front();
    for (std::size_t j = 0; j + 1 < legs_.size(); ++j) {
      for (; next < legs_[j + 1]; ++next) {
        const double time = nearest_to(path_.corners()[next + 1], j);
        pass(next, time);
        leave(next, time, j);
      }
    }
  }

  std::size_t leg(std::size_t knot) const { return legs_[knot]; }

 private:
  // So many steps around the piece in which the legs change, the tool may be nearest to the corner.
  static constexpr std::size_t kAround = 2;

  double nearest_to(const Vector& corner, std::size_t piece) const {
    const auto distance = [&](double time) {
      return (place_at(time, spline_.pieces()).of(spline_.points) - corner).squaredNorm();
    };
    const auto middle = static_cast<double>(piece) + 0.5;
    return least_argument(middle - kAround, middle + kAround, distance);
  }

  void leave(std::size_t leg, double time, std::size_t piece) {
    for (std::size_t j = std::max(piece, kAround) - kAround; j <= piece + kAround && j < legs_.size(); ++j) {
      legs_[j] = static_cast<double>(j) < time ? std::min(legs_[j], leg) : std::max(legs_[j], leg + 1);
    }
  }

  const StretchPath& path_;
  const TimeSpline& spline_;
  std::vector<std::size_t> legs_;
};

}  // namespace

void bound_motion(const StretchPath& path, const motion::AxisLimits& limits, const TimeSpline& spline,
                  std::span<const double> shares_of_tolerance, QuickestFit& fit) {
  fit.begin(spline.points);
  bound_limits(path, limits, spline, fit);
  const auto follow = [&](const PointSum& place, std::size_t leg) {
    fit.place(place, {.origin = path.corners()[leg],
                      .direction = path.legs()[leg].direction,
                      .radius = shares_of_tolerance[place.first + 1] * path.legs()[leg].tolerance});
  };
  Following following(path, spline);
  following.pass_corners([&](std::size_t leg, double time) {
    const PointSum nearest = place_at(time, spline.pieces());
    fit.place(nearest,
              {.origin = path.corners()[leg + 1], .radius = shares_of_tolerance[nearest.first + 1] * path.reach(leg)});
    for (const double away : kBesideCorner) {
      follow(place_at(time - away, spline.pieces()), leg);
      follow(place_at(time + away, spline.pieces()), leg + 1);
    }
  });
  for (std::size_t j = 0; j <= spline.pieces(); ++j) follow(knot(j), following.leg(j));
}

}  // namespace kcs::planning
