#include "server/motion/verifier.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "server/motion/contour.h"
#include "server/motion/polynomial.h"
#include "server/motion/route.h"
#include "server/motion/straight_run.h"

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

class Verifier {
 public:
  Verifier(const Reference& reference, const AxisLimits& limits)
      : start_(reference.points.front()),
        end_(reference.points.back()),
        limits_(limits),
        course_(reference),
        route_(course_, kRoundingShare * limits.velocity.head(static_cast<Eigen::Index>(limits.axes)).maxCoeff()) {
    for (std::size_t axis = limits.axes; axis < 3; ++axis) {
      limits_.velocity[axis] = limits_.acceleration[axis] = limits_.jerk[axis] = 0;
    }
  }

  Verification run(const Trajectory& trajectory) {
    Phase before{.start = {.position = start_}};  // at rest, for no time
    for (const Phase& phase : trajectory.phases) {
      if (phase.start_time != before.end_time()) fail(phase, "the phase does not start when the one before it ends");
      if (!check_shape(phase)) return result_;
      check_joint(phase, before, phase.start);
      check_limits(phase);
      check_path(phase);
      before = phase;
    }
    Phase end{.start_time = trajectory.duration(), .start = {.position = end_}};
    end.segments.first = end.segments.last = last_segment();
    check_joint(end, before, end.start);
    if (!(trajectory.end == end_)) fail(end, "the end is not that of the path");
    note(end, route_.finish());
    return result_;
  }

 private:
  std::uint32_t last_segment() const { return static_cast<std::uint32_t>(course_.segments()) - 1; }

  void fail(const Phase& phase, const std::string& what) {
    if (result_.fault.empty()) {
      result_.fault = fmt::format("segment {}, {:.6f} s: {}", phase.segments.first, phase.start_time, what);
    }
  }

  void note(const Phase& phase, const std::string& fault) {
    if (!fault.empty()) fail(phase, fault);
  }

  // After a phase without meaning there is nothing to measure.
  bool check_shape(const Phase& phase) {
    const bool finite = phase.start.position.allFinite() && phase.start.velocity.allFinite() &&
                        phase.start.acceleration.allFinite() && phase.jerk.allFinite() &&
                        std::isfinite(phase.start_time);
    if (!finite || !(phase.duration > 0) || !std::isfinite(phase.duration)) {
      fail(phase, "a phase is not a motion");
      return false;
    }
    if (phase.segments.first > phase.segments.last || phase.segments.last > last_segment()) {
      fail(phase, "a phase follows no segment");
      return false;
    }
    return true;
  }

  void check_joint(const Phase& phase, const Phase& previous, const State& after) {
    const State before = previous.at(previous.duration);
    const double gap = (after.position - before.position).norm();
    // Each side may have been reckoned from its own end of the line.
    double rounding = travel_rounding(previous) + position_rounding(after.position);
    for (const Piece& piece : course_.part(course_.pieces_of(phase.segments))) rounding += piece.rounding();
    if (!(gap <= kRoundingShare + rounding)) fail(phase, fmt::format("the position jumps by {} mm", gap));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      check_jump(phase, axis, "velocity", after.velocity[axis] - before.velocity[axis], limits_.velocity[axis]);
      check_jump(phase, axis, "acceleration", after.acceleration[axis] - before.acceleration[axis],
                 limits_.acceleration[axis]);
    }
  }

  void check_jump(const Phase& phase, std::size_t axis, const char* what, double jump, double limit) {
    if (!(std::abs(jump) <= kRoundingShare * limit)) {
      fail(phase, fmt::format("the {} of {} jumps by {}", what, kAxisNames[axis], jump));
    }
  }

  void check_limits(const Phase& phase) {
    check_limit(phase, "velocity", largest_velocity(phase), limits_.velocity, result_.max_velocity);
    check_limit(phase, "acceleration", largest_acceleration(phase), limits_.acceleration, result_.max_acceleration);
    check_limit(phase, "jerk", phase.jerk.cwiseAbs(), limits_.jerk, result_.max_jerk);
  }

  void check_limit(const Phase& phase, const char* what, const Vector& reached, const Vector& limit, Vector& largest) {
    largest = largest.cwiseMax(reached);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!(reached[axis] <= limit[axis] * (1 + kRoundingShare))) {
        fail(phase, fmt::format("the {} of {} reaches {}, its limit is {}", what, kAxisNames[axis], reached[axis],
                                limit[axis]));
      }
    }
  }

  void check_path(const Phase& phase) {
    const SegmentRange range = course_.pieces_of(phase.segments);
    note(phase, route_.follow(phase, range));
    const auto pieces = course_.part(range);
    double feed = std::numeric_limits<double>::infinity(), tolerance = feed, rounding = travel_rounding(phase);
    for (const Piece& piece : pieces) {
      feed = std::min(feed, piece.feed);
      tolerance = std::min(tolerance, piece.tolerance);
      rounding = std::max(rounding, piece.rounding());
    }
    const double speed = largest_speed(phase);
    result_.max_feed = std::max(result_.max_feed, speed);
    if (!(speed <= feed * (1 + kRoundingShare)))
      fail(phase, fmt::format("the feed reaches {} of {} mm/s", speed, feed));

    const double resolution = 1e-8 * tolerance + rounding;
    const double error =
        largest_contour_error(phase, pieces, resolution, std::min(result_.max_contour_error, tolerance * (1 - 1e-7)));
    result_.max_contour_error = std::max(result_.max_contour_error, error);
    if (!(error <= tolerance + 2 * rounding)) {
      fail(phase, fmt::format("the contour error reaches {} mm, the tolerance is {} mm", error, tolerance));
    }
  }

  Vector start_, end_;  // of the path
  AxisLimits limits_;
  Course course_;
  Route route_;
  Verification result_;
};

}  // namespace

Verification verify(const Trajectory& trajectory, const Reference& reference, const AxisLimits& limits) {
  return Verifier(reference, limits).run(trajectory);
}

}  // namespace kcs::motion
