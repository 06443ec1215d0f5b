// A stretch of the path whose corners are too near to each other to be taken one by one: one smooth motion through all
// of them.
#pragma once

#include <vector>

#include "server/planning/options.h"
#include "server/planning/smooth_motion.h"
#include "server/planning/stretch_path.h"

namespace kcs::planning {

// The motion is looked for window by window: each goes on from the one before it, and looks ahead as far as the tool
// needs to stop, and more. So neither time nor what a failure spoils grows with the length of the stretch.
class Stretch {
 public:
  // `path` and `options` must outlive the stretch. Its legs have tolerances of more than 0. at_most: the speeds at its
  // ends, 0 for rest.
  Stretch(const LegPath& path, const LegRange& range, const PlanOptions& options, const EndSpeeds& at_most);

  // No motion that keeps everything was found: the stretch has to be travelled in another way.
  bool failed() const { return spline_.points.empty(); }

  // A motion whose speeds at the ends are at most these, mm/s; the speeds that it has. If it fails, they are 0.
  EndSpeeds plan(const EndSpeeds& at_most);

  const StretchPath& path() const { return path_; }
  const TimeSpline& spline() const { return spline_; }
  EndSpeeds speeds() const { return speeds_; }
  // A piece of the spline, with the segments of the whole path.
  motion::Phase phase(std::size_t piece) const;

 private:
  void search(const EndSpeeds& at_most);
  double stopping_way(double feed) const;
  double beyond(double from, double steps, double least) const;
  double ahead(double from, double share) const;
  bool search_window(double until, double to, const EndSpeeds& at_most, bool last);
  void follow_tail();
  MotionDraft draft(const MotionRange& range, double step) const;
  void commit(const SmoothMotion& motion, double until, bool last);

  const PlanOptions& options_;
  StretchPath path_;
  double step_;        // s
  TimeSpline spline_;  // what is settled
  EndSpeeds speeds_;
  double work_left_ = 0;  // rounds times points
  TimeSpline tail_;       // what was found beyond it, to a stop: from the last three settled points on
  FitWeights tail_weights_;
};

}  // namespace kcs::planning
