// How much of each limit and of the tolerance a smooth motion takes.
#pragma once

#include <cstddef>
#include <span>
#include <stop_token>
#include <utility>
#include <vector>

#include "server/motion/limits.h"
#include "server/planning/stretch_path.h"
#include "server/planning/stretch_piece.h"
#include "server/planning/time_spline.h"

namespace kcs::planning {

// The shares of the feed, and of the axes' acceleration and jerk, at which a search aims, inverted: so that it ends
// inside them.
inline constexpr double kAimSpeed = 1.006, kAimLimits = 1.02;

// What a search for a motion is at.
struct SearchMode {
  bool crowded = false;    // sharp corners follow each other within a few steps
  bool brisk = false;      // it is for a dense part of a long path (density.h): its rounds count
  bool finishing = false;  // time is only stretched
  bool urgent = false;     // finishing has taken long
  // Steps at the end that are beyond what will be settled: it matters little how long they take.
  std::size_t spare_end = 0;
  // Steps beside an end whose speed is given, over which time is stretched little: there a slower tool would have to
  // brake at once.
  double held_start = 0, held_end = 0;
};

// 1: all of it. Measured again and again while a motion is looked for, so cheaply: places at the points and, if
// it is done closely, in the middle between them; limits exactly, because a spline of time has its extremes in its
// differences.
class MotionShares {
 public:
  // To be called first. The motions that are measured go on from these pieces, or begin here if there are none: corners
  // that they have come near to are done with. Measuring throws Stopped if `stop` asks for it.
  void begin(const StretchPath& path, std::span<const StretchPiece> settled, const std::stop_token& stop);

  // Measures the spline, whose points were drawn to the legs `legs`. Moves ways and legs of all points but the first
  // and the last three to the places on the path that the curve is nearest to.
  void measure(const StretchPath& path, const motion::AxisLimits& limits, TimeSpline& spline,
               std::vector<std::size_t>& legs, bool closely);

  // Looks for what the measuring missed, by the means of the verifier; raises the shares there. True if all is well.
  bool verify_places(const StretchPath& path, const motion::AxisLimits& limits, const TimeSpline& spline);

  // Of the tolerance, at each point.
  const std::vector<double>& place() const { return place_; }
  // Of the limits: entry j belongs to the difference that begins at point j. Haste is the share of the speed, but where
  // the feed changes, of that from which the tool can still come down to the lower feed, or that it can have reached
  // since then.
  const std::vector<double>& haste() const { return haste_; }
  const std::vector<double>& acceleration() const { return acceleration_; }
  const std::vector<double>& jerk() const { return jerk_; }
  // The same, axis by axis.
  const std::vector<Vector>& axis_jerk() const { return axis_jerk_; }

  double largest_place() const { return largest_place_; }
  // How much slower the motion must become so that every limit is kept; ≤ 1: they are.
  double slower() const;

 private:
  void measure_places(const StretchPath& path, TimeSpline& spline, std::vector<std::size_t>& legs, bool closely);
  void measure_corners(const StretchPath& path, TimeSpline& spline);
  void measure_limits(const StretchPath& path, const motion::AxisLimits& limits, const TimeSpline& spline);
  void measure_haste(const motion::AxisLimits& limits, const TimeSpline& spline);
  // `followed`: the first and the last leg.
  bool verify_piece(const StretchPath& path, const motion::AxisLimits& limits, const TimeSpline& spline,
                    std::size_t piece, const std::pair<std::size_t, std::size_t>& followed);
  void pass_corners(const StretchPath& path, const motion::Phase& phase, std::size_t first, std::size_t last);
  bool verify_corners(const StretchPath& path, const TimeSpline& spline);
  void raise(std::size_t from, std::size_t count, double share);

  std::stop_token stop_;
  std::vector<double> place_, speed_, haste_, acceleration_, jerk_;
  std::vector<Vector> axis_jerk_;
  std::vector<double> feeds_;     // mm/s, where each speed belongs
  std::vector<double> drawn_to_;  // the ways that the points were drawn to
  std::vector<double> mitres_;    // of the piece that is looked at
  double largest_place_ = 0;
  std::vector<bool> reached_;     // the corner at the end of each leg
  std::size_t first_corner_ = 0;  // that is not done with
};

}  // namespace kcs::planning
