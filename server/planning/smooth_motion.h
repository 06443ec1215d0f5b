// One smooth motion through many corners at once, whose transitions overlap.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <stop_token>
#include <vector>

#include "server/motion/limits.h"
#include "server/motion/verifier.h"
#include "server/planning/motion_shares.h"
#include "server/planning/paces.h"
#include "server/planning/penalized_fit.h"
#include "server/planning/stretch_path.h"
#include "server/planning/time_spline.h"

namespace kcs::planning {

// Speeds at two ends, mm/s; 0: rest.
struct EndSpeeds {
  double entry = 0;
  double exit = 0;
};

// Which part of a stretch a motion covers, and how it begins and ends.
struct MotionRange {
  double from = 0, to = 0;  // ways, mm
  EndSpeeds at_most;        // the greatest speeds there; what begins or ends at rest does so exactly
  bool exact = false;       // these are the speeds there
  Effort effort = Effort::kFull;
  bool dense = false;  // legs follow each other within a few of its points (density.h)
  // The motion goes on from these three points, if there are any, whatever `from` and at_most.entry are…
  const TimeSpline* before = nullptr;
  // …and these are the pieces that lead there.
  std::span<const StretchPiece> settled = {};
};

// Ways at equal times, with how much each point is held: what a search begins with.
struct MotionDraft {
  double step = 0;  // s
  std::vector<double> ways;
  FitWeights weights;
};

// The step of time that suits these limits and the tolerance (mm), s: a fraction of the time in which an axis reaches
// its acceleration, and of the time that a corner takes, be it for want of jerk or of acceleration.
double step_of_time(double tolerance, const motion::AxisLimits& limits);
// A longer one, for less work (density.h). Where legs follow each other within a few steps, what is asked for changes
// slowly, and the motion becomes as fast; where corners are rare, each takes a millisecond or two longer.
double long_step_of_time(double tolerance, const motion::AxisLimits& limits);

// The corners at the ends of a leg of more steps than this at the feed are apart: one motion through both would cost
// more than it can win.
constexpr double kMostSteps = 80;

// A motion of more points than this is not worth its search.
constexpr double kMostPoints = 5'000;

// Planning looks at so many steps beyond what it settles, at least (horizon.h): what is found for them only leads to
// rest, and is searched again.
constexpr std::size_t kStepsAhead = 80;

// Finds a motion that is near to the fastest, as a spline of time. It starts from a draft and changes time and place in
// turns: the points of the spline are drawn to the path only where they are too far away from it, else they avoid
// jerk; time is stretched where an axis is beyond a limit and shortened where none is near to one. What presses on a
// limit or on the tolerance again and again gets more and more weight.
// The idea is that of overlapping transitions: a spline of time is a sum of equal pulses of velocity, and so what the
// axes do is the sum of what all corners near by ask for. Most rounds are done with steps of twice the length.
// Linear in the duration of the motion. Deterministic.
class SmoothMotion {
 public:
  // All three references must outlive the motion. step: s, see step_of_time.
  SmoothMotion(const StretchPath& path, const motion::AxisLimits& limits, double step, const std::stop_token& stop);

  // Looks for a motion inside all limits and the tolerance, judged by the means of the verifier. False if none was
  // found within a bounded number of rounds. Throws Stopped.
  bool search(const MotionRange& range, MotionDraft draft);

  // What was found. Its step is a little longer than what was asked for if that was what it took.
  const TimeSpline& spline() const { return spline_; }
  EndSpeeds speeds() const { return speeds_; }
  // The weights that it has come to.
  const FitWeights& weights() const { return weights_; }

 private:
  void change_step(double step);
  void find_start();
  void hold_ends();
  void fit();
  bool accept();
  double allowed() const;
  bool stands(const std::vector<double>& draft, double step) const;
  void slow_down_evenly();
  void find_held_steps();
  double retime();
  void resample(std::size_t count);
  void slow_ends_down();

  const StretchPath& path_;
  const motion::AxisLimits& limits_;
  double step_;
  const std::stop_token& stop_;
  double hold_time_;  // s, which all times of holding are shares of
  MotionRange range_;
  EndSpeeds speeds_;
  TimeSpline spline_;
  FitWeights weights_;
  PenalizedFit fit_;
  MotionShares shares_;
  Paces paces_;
  // The first three points and their ways, if the motion goes on from another one.
  std::array<Vector, 3> start_points_;
  std::array<double, 3> start_ways_ = {};
  SearchMode mode_;
  double least_step_ = 0;  // see kLeastStep
  double eased_ = 0;       // see kEasing
  double missing_ = 0;     // steps that were asked for while finishing, and not given yet
  // Scratch, kept from round to round.
  std::vector<std::size_t> legs_;  // of the ways
  std::vector<Vector> data_;       // on the path
  std::vector<double> drawn_to_;   // the ways of data_
  std::vector<double> old_ways_, old_times_;
  FitWeights old_weights_;
};

}  // namespace kcs::planning
