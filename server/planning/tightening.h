// Makes a motion faster that was found already.
#pragma once

#include <cstddef>
#include <span>
#include <stop_token>
#include <vector>

#include "server/motion/limits.h"
#include "server/planning/motion_shares.h"
#include "server/planning/quickest_fit.h"
#include "server/planning/stretch_path.h"
#include "server/planning/stretch_piece.h"
#include "server/planning/time_spline.h"

namespace kcs::planning {

// A search (smooth_motion.h) ends where some axis is at a limit all the time. To have all axes there, bends have to be
// moved about in the tolerance and in time, all of them at once. As long as the tool follows the same legs at the same
// times, that is a convex program (quickest_fit.h): it is solved, time goes by faster, and what was found is followed
// anew, a few times. The motion begins and ends as before. Corners every few steps are travelled about 3 % faster.
// Deterministic; takes several times as long as a search.
class Tightening {
 public:
  // All three must outlive this.
  Tightening(const StretchPath& path, const motion::AxisLimits& limits, const std::stop_token& stop);

  // A motion of as many steps, which are shorter, or the same motion. It goes on from these pieces. Throws Stopped.
  TimeSpline run(const TimeSpline& spline, std::span<const StretchPiece> settled);

 private:
  bool keeps_everything();
  void look_closer();
  void set_step(double step);

  const StretchPath& path_;
  const motion::AxisLimits& limits_;
  const std::stop_token& stop_;
  TimeSpline spline_;
  QuickestFit fit_;
  MotionShares shares_;
  std::vector<std::size_t> legs_;            // of the ways
  std::vector<double> shares_of_tolerance_;  // that each point may take
};

}  // namespace kcs::planning
