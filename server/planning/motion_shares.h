// How much of each limit and of the tolerance a smooth motion takes.
#pragma once

#include <cstddef>
#include <vector>

#include "server/motion/limits.h"
#include "server/planning/stretch_path.h"
#include "server/planning/time_spline.h"

namespace kcs::planning {

// The share of a feed, or of what an axis can do, at which a search aims, inverted: so that it ends inside it.
inline constexpr double kAimSpeed = 1.006;

// 1: all of it. Measured again and again while a motion is looked for, so cheaply: places at the points and, if
// it is done closely, in the middle between them; limits exactly, because a spline of time has its extremes in its
// differences.
class MotionShares {
 public:
  // Measures the spline, whose points were drawn to the legs `legs`. Moves ways and legs of all points but the first
  // and the last three to the places on the path that the curve is nearest to.
  void measure(const StretchPath& path, const motion::AxisLimits& limits, TimeSpline& spline,
               std::vector<std::size_t>& legs, bool closely);

  // Looks for what the measuring missed, by the means of the verifier; raises the shares there. True if all is well.
  bool verify_places(const StretchPath& path, const motion::AxisLimits& limits, const TimeSpline& spline);

  // Of the tolerance, at each point.
  const std::vector<double>& place() const { return place_; }
  // Of the limits: entry j belongs to the difference that begins at point j.
  const std::vector<double>& speed() const { return speed_; }
  const std::vector<double>& acceleration() const { return acceleration_; }
  const std::vector<double>& jerk() const { return jerk_; }

  double largest_place() const { return largest_place_; }
  // How much longer each step should take, smoothed over its neighbours; less than 1 only if it is not `finishing`.
  // While finishing, also what is too far away from the path takes longer. `urgent`: all that is asked for at once, not
  // half of it.
  const std::vector<double>& paces(bool finishing, bool urgent);
  // How much slower the motion must become so that every limit is kept; ≤ 1: they are.
  double slower() const;

 private:
  void measure_places(const StretchPath& path, TimeSpline& spline, std::vector<std::size_t>& legs, bool closely);
  void measure_corners(const StretchPath& path, TimeSpline& spline);
  void measure_limits(const StretchPath& path, const motion::AxisLimits& limits, const TimeSpline& spline);
  bool verify_piece(const StretchPath& path, const motion::AxisLimits& limits, const TimeSpline& spline,
                    std::size_t piece);
  bool verify_corners(const StretchPath& path, const TimeSpline& spline);
  void raise(std::size_t from, std::size_t count, double share);

  std::vector<double> place_, speed_, acceleration_, jerk_;
  std::vector<double> wishes_, paces_;
  double largest_place_ = 0;
  std::vector<bool> reached_;  // the corners from first_corner_ on
  std::size_t first_corner_ = 0;
};

}  // namespace kcs::planning
