#include "server/motion/verifier.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "server/motion/contour.h"
#include "server/motion/polynomial.h"
#include "server/motion/straight_run.h"

namespace kcs::motion {
namespace {

constexpr const char* kAxisNames = "XYZ";

class Verifier {
 public:
  Verifier(const Reference& reference, const AxisLimits& limits)
      : reference_(reference), limits_(limits), gauge_(reference.points) {
    for (std::size_t axis = limits.axes; axis < 3; ++axis) {
      limits_.velocity[axis] = limits_.acceleration[axis] = limits_.jerk[axis] = 0;
    }
  }

  Verification run(const Trajectory& trajectory) {
    State at{.position = reference_.points.front()};
    double time = 0;
    for (const Phase& phase : trajectory.phases) {
      if (phase.start_time != time) fail(phase, "a phase does not start at the time when the one before it ends");
      time = phase.end_time();
      check_joint(phase, at, phase.start);
      check_limits(phase);
      if (check_shape(phase)) check_path(phase);
      at = phase.at(phase.duration);
    }
    const Phase end{.start_time = trajectory.duration(),
                    .start = {.position = reference_.points.back()},
                    .segments = {last_segment(), last_segment()}};
    check_joint(end, at, end.start);
    check_joint(end, {.position = trajectory.end}, end.start);
    return result_;
  }

 private:
  std::uint32_t last_segment() const { return static_cast<std::uint32_t>(reference_.feed.size()) - 1; }

  void fail(const Phase& phase, const std::string& what) {
    if (result_.fault.empty()) {
      result_.fault = fmt::format("segment {}, {:.6f} s: {}", phase.segments.first, phase.start_time, what);
    }
  }

  // After a phase without meaning there is no path to measure.
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

  void check_joint(const Phase& phase, const State& before, const State& after) {
    const double gap = (after.position - before.position).norm();
    if (!(gap <= kRoundingShare + position_rounding(after.position))) {
      fail(phase, fmt::format("the position jumps by {} mm", gap));
    }
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
    double feed = std::numeric_limits<double>::infinity(), tolerance = feed;
    for (std::size_t i = phase.segments.first; i <= phase.segments.last; ++i) {
      feed = std::min(feed, reference_.feed[i]);
      tolerance = std::min(tolerance, reference_.tolerance[i]);
    }
    const double speed = largest_speed(phase);
    result_.max_feed = std::max(result_.max_feed, speed);
    if (!(speed <= feed * (1 + kRoundingShare)))
      fail(phase, fmt::format("the feed reaches {} of {} mm/s", speed, feed));

    const double rounding = position_rounding(phase.start.position) +
                            position_rounding(reference_.points[phase.segments.first]) +
                            position_rounding(reference_.points[phase.segments.last + 1]);
    const double resolution = 1e-8 * tolerance + rounding;
    const double error =
        gauge_.largest_error(phase, resolution, std::min(result_.max_contour_error, tolerance * (1 - 1e-7)));
    result_.max_contour_error = std::max(result_.max_contour_error, error);
    if (!(error <= tolerance + rounding)) {
      fail(phase, fmt::format("the contour error reaches {} mm, the tolerance is {} mm", error, tolerance));
    }
  }

  Reference reference_;
  AxisLimits limits_;
  ContourGauge gauge_;
  Verification result_;
};

}  // namespace

Verification verify(const Trajectory& trajectory, const Reference& reference, const AxisLimits& limits) {
  return Verifier(reference, limits).run(trajectory);
}

}  // namespace kcs::motion
