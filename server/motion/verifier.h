// Judges a motion from its phases alone; it knows nothing of how they were planned.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "server/motion/course.h"
#include "server/motion/limits.h"
#include "server/motion/route.h"
#include "server/motion/trajectory.h"

namespace kcs::motion {

// How far beyond a limit rounding may go, relative to the limit.
inline constexpr double kRoundingShare = 1e-9;

// What a motion reaches: from the exact extremes of its polynomials, not from samples.
struct Verification {
  Vector max_velocity = Vector::Zero();      // largest magnitude on each axis, mm/s
  Vector max_acceleration = Vector::Zero();  // mm/s²
  Vector max_jerk = Vector::Zero();          // mm/s³
  double max_feed = 0;                       // along the path, mm/s
  double max_contour_error = 0;              // mm
  std::string fault;                         // the first thing that is wrong, with its time and segment; empty: none

  bool passed() const { return fault.empty(); }
};

// Checks a motion while it is made: that it starts and ends on the path's ends, at rest or as it is asked to; that
// time, position, velocity and acceleration are continuous at every joint; that no axis exceeds a limit, the speed no
// feed (of any segment that a phase follows), and the contour error no tolerance (of every segment that a phase
// follows: the smallest counts); that the path is travelled in order and forward, comes as near to each corner as it
// must, and rests where and as long as it must.
// Path and phases come in order; what the phases have left behind is forgotten. Memory: that of the path ahead of the
// motion. Time: linear in the number of phases, each with the pieces it follows.
class Verifier {
 public:
  // start: where the path begins, and the velocity and acceleration that the motion must begin with.
  Verifier(const State& start, const AxisLimits& limits);

  // The next segment of the path.
  void add(const PathSegment& segment) { course_.add(segment); }

  // How many segments are known as well as they ever will be. Later ones may get longer, because segments on one line
  // count as one; a phase that follows them is judged by what is known of them.
  std::uint32_t settled_segments() const { return course_.settled_segments(); }

  // The next phase. The segments that it follows must have been added.
  // A corner that is missed shows when the motion has left both of its sides.
  void follow(const Phase& phase);

  // After the last segment and the last phase. end: what the trajectory says of its end; velocity: what it must be
  // there, mm/s, without acceleration.
  Verification finish(const State& end, const Vector& velocity = Vector::Zero());

  // What is known so far.
  const Verification& so_far() const { return result_; }

 private:
  void check_joint(const Phase& phase, const SegmentRange& pieces);
  void check_jump(const Phase& phase, const char* what, const Vector& jump, const Vector& limit);
  void check_limits(const Phase& phase);
  void check_limit(const Phase& phase, const char* what, const Vector& reached, const Vector& limit, Vector& largest);
  void check_path(const Phase& phase, const SegmentRange& pieces);
  void fail(const Phase& phase, const std::string& what);
  void note(const Phase& phase, const std::string& fault);

  AxisLimits limits_;
  Course course_;
  Route route_;
  bool broken_ = false;  // a phase had no meaning: there is nothing to measure after it
  // Where the last phase ended, and what of that position its rounding leaves open, mm.
  double end_time_ = 0;
  State end_;
  double end_rounding_;
  std::vector<double> mitres_;  // of the phase that is looked at
  Verification result_;
};

// What was asked for. Segment i goes from points[i] to points[i + 1]; the other arrays have one entry per segment.
struct Reference {
  std::span<const Vector> points;     // mm, one more than segments; at least 2
  std::span<const double> feed;       // mm/s, and so on: see PathSegment
  std::span<const double> tolerance;  // mm
  std::span<const double> reach;      // mm
  std::span<const double> rest;       // s
  // How the motion begins and ends, along the first and the last segment; at rest unless said.
  Vector start_velocity = Vector::Zero();      // mm/s
  Vector start_acceleration = Vector::Zero();  // mm/s²
  Vector end_velocity = Vector::Zero();        // mm/s
};

// Verifies a finished trajectory. Memory: that of the longest straight run of segments.
Verification verify(const Trajectory& trajectory, const Reference& reference, const AxisLimits& limits);

}  // namespace kcs::motion
