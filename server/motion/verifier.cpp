#include "server/motion/verifier.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "server/motion/contour.h"
#include "server/motion/mitres.h"
#include "server/motion/polynomial.h"

namespace kcs::motion {
namespace {

constexpr const char* kAxisNames = "XYZ";

// What the end of a phase cannot be told better than, mm: its start, and each term that is added to it, is rounded.
double travel_rounding(const Phase& phase) {
  const double t = phase.duration;
  const Vector travel = phase.start.velocity.cwiseAbs() * t + phase.start.acceleration.cwiseAbs() * (t * t / 2) +
                        phase.jerk.cwiseAbs() * (t * t * t / 6);
  return position_rounding(phase.start.position) + position_rounding(travel);
}

bool is_motion(const Phase& phase) {
  const bool finite = phase.start.position.allFinite() && phase.start.velocity.allFinite() &&
                      phase.start.acceleration.allFinite() && phase.jerk.allFinite() &&
                      std::isfinite(phase.start_time) && std::isfinite(phase.duration);
  return finite && phase.duration > 0;
}

// Only the axes that the machine has may move.
AxisLimits without_missing_axes(AxisLimits limits) {
  for (std::size_t axis = limits.axes; axis < 3; ++axis) {
    limits.velocity[axis] = limits.acceleration[axis] = limits.jerk[axis] = 0;
  }
  return limits;
}

}  // namespace

Verifier::Verifier(const State& start, const AxisLimits& limits)
    : limits_(without_missing_axes(limits)),
      course_(start.position),
      route_(kRoundingShare * limits_.velocity.maxCoeff()),
      end_(start),
      end_rounding_(position_rounding(start.position)) {}

void Verifier::follow(const Phase& phase) {
  if (broken_) return;
  broken_ = true;  // unless the phase has a meaning
  if (!is_motion(phase)) return fail(phase, "a phase is not a motion");
  if (phase.segments.first > phase.segments.last || phase.segments.last >= course_.segments()) {
    return fail(phase, "a phase follows no segment");
  }
  const SegmentRange range = course_.pieces_of(phase.segments);
  if (!route_.goes_on_with(range)) {
    return fail(phase, "a part of the path is left out or travelled out of order");
  }
  broken_ = false;

  if (phase.start_time != end_time_) fail(phase, "the phase does not start when the one before it ends");
  check_joint(phase, range);
  check_limits(phase);
  const State end = phase.at(phase.duration);
  end_time_ = phase.end_time();
  end_rounding_ = travel_rounding(phase);
  end_ = end;
  check_path(phase, range);
  course_.forget_before(route_.first_needed());
}

Verification Verifier::finish(const State& end, const Vector& velocity) {
  if (broken_) return result_;
  const std::uint32_t last = course_.segments() - 1;
  const Phase after{
      .start_time = end_time_, .start = {.position = course_.end(), .velocity = velocity}, .segments = {last, last}};
  check_joint(after, course_.pieces_of(after.segments));
  const bool as_asked = end.position == after.start.position && end.velocity == after.start.velocity &&
                        end.acceleration == after.start.acceleration;
  if (!as_asked) fail(after, "the end is not that of the path");
  note(after, route_.finish(course_));
  return result_;
}

void Verifier::fail(const Phase& phase, const std::string& what) {
  if (result_.fault.empty()) {
    result_.fault = fmt::format("segment {}, {:.6f} s: {}", phase.segments.first, phase.start_time, what);
  }
}

void Verifier::note(const Phase& phase, const std::string& fault) {
  if (!fault.empty()) fail(phase, fault);
}

void Verifier::check_joint(const Phase& phase, const SegmentRange& range) {
  const State& after = phase.start;
  const double gap = (after.position - end_.position).norm();
  // Each side may have been reckoned from its own end of the line.
  double rounding = end_rounding_ + position_rounding(after.position) + course_.piece(range.first).rounding;
  if (range.last != range.first) rounding += course_.piece(range.last).rounding;
  if (!(gap <= kRoundingShare + rounding)) fail(phase, fmt::format("the position jumps by {} mm", gap));
  check_jump(phase, "velocity", after.velocity - end_.velocity, limits_.velocity);
  check_jump(phase, "acceleration", after.acceleration - end_.acceleration, limits_.acceleration);
}

void Verifier::check_jump(const Phase& phase, const char* what, const Vector& jump, const Vector& limit) {
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (!(std::abs(jump[axis]) <= kRoundingShare * limit[axis])) {
      fail(phase, fmt::format("the {} of {} jumps by {}", what, kAxisNames[axis], jump[axis]));
    }
  }
}

void Verifier::check_limits(const Phase& phase) {
  check_limit(phase, "velocity", largest_velocity(phase), limits_.velocity, result_.max_velocity);
  check_limit(phase, "acceleration", largest_acceleration(phase), limits_.acceleration, result_.max_acceleration);
  check_limit(phase, "jerk", phase.jerk.cwiseAbs(), limits_.jerk, result_.max_jerk);
}

void Verifier::check_limit(const Phase& phase, const char* what, const Vector& reached, const Vector& limit,
                           Vector& largest) {
  largest = largest.cwiseMax(reached);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (!(reached[axis] <= limit[axis] * (1 + kRoundingShare))) {
      fail(phase,
           fmt::format("the {} of {} reaches {}, its limit is {}", what, kAxisNames[axis], reached[axis], limit[axis]));
    }
  }
}

void Verifier::check_path(const Phase& phase, const SegmentRange& range) {
  const std::span<const Piece> pieces = course_.part(range);
  pass_mitres(phase, pieces, mitres_);
  note(phase, route_.follow(phase, end_, course_, range, mitres_));

  double feed = std::numeric_limits<double>::infinity(), tolerance = feed, rounding = end_rounding_;
  for (const Piece& piece : pieces) {
    feed = std::min(feed, piece.feed);
    tolerance = std::min(tolerance, piece.tolerance);
    rounding = std::max(rounding, piece.rounding);
  }
  const double speed = largest_speed(phase);
  result_.max_feed = std::max(result_.max_feed, speed);
  if (!(speed <= feed * (1 + kRoundingShare))) fail(phase, fmt::format("the feed reaches {} of {} mm/s", speed, feed));

  const double resolution = 1e-8 * tolerance + rounding;
  const double known = std::min(result_.max_contour_error, tolerance * (1 - 1e-7));
  const double error = largest_contour_error(phase, pieces, mitres_, resolution, known);
  result_.max_contour_error = std::max(result_.max_contour_error, error);
  if (!(error <= tolerance + 2 * rounding)) {
    fail(phase, fmt::format("the contour error reaches {} mm, the tolerance is {} mm", error, tolerance));
  }
}

Verification verify(const Trajectory& trajectory, const Reference& reference, const AxisLimits& limits) {
  const State start{reference.points.front(), reference.start_velocity, reference.start_acceleration};
  Verifier verifier(start, limits);
  std::size_t added = 0;
  const auto add = [&] {
    verifier.add({reference.points[added + 1], reference.feed[added], reference.tolerance[added],
                  reference.reach[added], reference.rest[added]});
    ++added;
  };
  for (const Phase& phase : trajectory) {
    while (added < reference.feed.size() && verifier.settled_segments() <= phase.segments.last) add();
    verifier.follow(phase);
  }
  while (added < reference.feed.size()) add();
  return verifier.finish(trajectory.final_state(), reference.end_velocity);
}

}  // namespace kcs::motion
