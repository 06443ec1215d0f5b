#include "tests/property/judge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace kcs::test {
namespace {

using motion::Phase;
using motion::State;
using motion::Vector;
using planning::Plan;

// No limit is exceeded by more than rounding.
constexpr double kLimit = 1 + 1e-9;

// Whether a point is this near to some place of the whole path, not only of the segments that a phase names. It tries
// from segment `guess` on first.
bool is_near(const Vector& point, const planning::Toolpath& path, double distance, std::size_t guess) {
  const std::size_t size = path.segments.size();
  for (std::size_t k = 0; k < size; ++k) {
    const std::size_t i = (guess + k) % size;
    const Vector from = path.start_of(i), along = path.segments[i].end - from;
    const double square = along.squaredNorm();
    const double share = square > 0 ? std::clamp((point - from).dot(along) / square, 0.0, 1.0) : 0;
    if ((point - from - share * along).norm() <= distance) return true;
  }
  return false;
}

// The segments of the case that count, as phases number them.
std::vector<planning::Segment> moving_segments(const planning::Toolpath& path) {
  std::vector<planning::Segment> result;
  for (std::size_t i = 0; i < path.segments.size(); ++i) {
    if ((path.segments[i].end - path.start_of(i)).norm() >= planning::kNoLength) result.push_back(path.segments[i]);
  }
  return result;
}

// By samples, and by halving the time around the best one.
double nearest_in(const Phase& phase, const Vector& point) {
  const auto distance = [&](double time) { return (phase.at(time).position - point).norm(); };
  double step = phase.duration / 8, best = 0;
  for (int i = 1; i <= 8; ++i) {
    if (distance(step * i) < distance(best)) best = step * i;
  }
  for (; step > 1e-12 * phase.duration; step /= 2) {
    for (const double time : {best - step / 2, best + step / 2}) {
      if (time >= 0 && time <= phase.duration && distance(time) < distance(best)) best = time;
    }
  }
  return distance(best);
}

class Judge {
 public:
  Judge(const Case& problem, const Plan& plan)
      : problem_(problem), plan_(plan), segments_(moving_segments(problem.path)) {
    for (const auto& segment : problem.path.segments) {
      rounding_ = std::max(rounding_, 1e-15 * segment.end.cwiseAbs().maxCoeff());
    }
  }

  void run() {
    State at = beginning();
    double time = 0;
    for (const Phase& phase : plan_.trajectory) {
      ASSERT_GT(phase.duration, 0);
      ASSERT_EQ(phase.start_time, time);
      continuous(at, phase.start);
      for (int i = 0; i <= 8; ++i) inside_limits(phase, phase.at(phase.duration * i / 8));
      at = phase.at(phase.duration);
      time = phase.end_time();
      phases_.push_back(phase);
    }
    const State end = ending();
    continuous(at, end);
    EXPECT_LE((plan_.trajectory.final_state().position - end.position).norm(), 1e-9);
    EXPECT_LE((plan_.trajectory.final_state().velocity - end.velocity).norm(), 1e-9 * end.velocity.norm());
    stops_are_reached();
    corners_keep_their_tolerance();
  }

 private:
  // As it is asked for.
  State beginning() const {
    const planning::PathEnds& ends = problem_.path;
    State state{.position = ends.start};
    if (segments_.empty()) return state;
    const Vector direction = direction_of(segments_.front(), ends.start, plan_.trajectory.begin()->start.velocity);
    state.velocity = ends.start_speed * direction;
    state.acceleration = ends.start_acceleration * direction;
    return state;
  }
  State ending() const {
    State state{.position = problem_.path.segments.back().end};
    if (segments_.empty()) return state;
    const Vector before = segments_.size() > 1 ? segments_.end()[-2].end : problem_.path.start;
    state.velocity =
        problem_.path.end_speed * direction_of(segments_.back(), before, plan_.trajectory.final_state().velocity);
    return state;
  }
  // That of the motion, if rounding can explain what it differs by from that of the segment.
  Vector direction_of(const planning::Segment& segment, const Vector& from, const Vector& velocity) const {
    const Vector direction = (segment.end - from).normalized();
    const double rounding = 16 * rounding_ / (segment.end - from).norm();
    return (velocity.normalized() - direction).norm() <= rounding ? velocity.normalized() : direction;
  }

  void continuous(const State& before, const State& after) {
    const auto& limits = problem_.options.limits;
    EXPECT_LE((after.position - before.position).norm(), 1e-9 + 16 * rounding_);
    for (std::size_t axis = 0; axis < limits.axes; ++axis) {
      EXPECT_LE(std::abs(after.velocity[axis] - before.velocity[axis]), 1e-9 * limits.velocity[axis]);
      EXPECT_LE(std::abs(after.acceleration[axis] - before.acceleration[axis]), 1e-9 * limits.acceleration[axis]);
    }
  }

  void inside_limits(const Phase& phase, const State& state) {
    const auto& limits = problem_.options.limits;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool exists = axis < limits.axes;
      EXPECT_LE(std::abs(state.velocity[axis]), exists ? limits.velocity[axis] * kLimit : 0);
      EXPECT_LE(std::abs(state.acceleration[axis]), exists ? limits.acceleration[axis] * kLimit : 0);
      EXPECT_LE(std::abs(phase.jerk[axis]), exists ? limits.jerk[axis] * kLimit : 0);
    }
    double feed = INFINITY, tolerance = 0, forward = segments_.empty() ? 0 : -INFINITY;
    for (std::size_t i = phase.segments.first; i <= phase.segments.last && !segments_.empty(); ++i) {
      feed = std::min(feed, segments_.at(i).feed);
      tolerance = std::max(tolerance, segments_[i].tolerance);
      const Vector& from = i == 0 ? problem_.path.start : segments_[i - 1].end;
      forward = std::max(forward, state.velocity.dot((segments_[i].end - from).normalized()));
    }
    EXPECT_LE(state.velocity.norm(), feed * kLimit);
    EXPECT_GE(forward, -1e-6 * limits.velocity.maxCoeff()) << "on segment " << phase.segments.first;
    EXPECT_TRUE(is_near(state.position, problem_.path, tolerance + 16 * rounding_, phase.segments.first))
        << "at " << state.position.transpose() << " on segment " << phase.segments.first;
  }

  void stops_are_reached() {
    for (const auto& segment : problem_.path.segments) {
      if (!segment.stop && segment.dwell == 0) continue;
      double nearest = (plan_.trajectory.final_state().position - segment.end).norm();
      for (const Phase& phase : plan_.trajectory) {
        if (phase.start.velocity.norm() <= 1e-9 * problem_.options.limits.velocity.maxCoeff()) {
          nearest = std::min(nearest, (phase.start.position - segment.end).norm());
        }
      }
      EXPECT_LE(nearest, 2e-9 + 16 * rounding_);
    }
  }

  // The corner distance is not something that the contour error shows.
  void corners_keep_their_tolerance() {
    std::size_t first = 0;  // of the phases that may be near
    for (const planning::Corner corner : plan_.corners) {
      ASSERT_LT(corner.segment + 1, segments_.size());
      const double tolerance = std::min(segments_[corner.segment].tolerance, segments_[corner.segment + 1].tolerance);
      const bool contour = problem_.options.tolerance_kind == planning::ToleranceKind::kContourError;
      EXPECT_LE(corner.corner_distance, tolerance * (contour ? 4 : 1));
      EXPECT_LE(corner.contour_error, tolerance);
      double nearest = INFINITY;
      while (first < phases_.size() && phases_[first].segments.last < corner.segment) ++first;
      for (std::size_t i = first; i < phases_.size() && phases_[i].segments.first <= corner.segment + 1; ++i) {
        nearest = std::min(nearest, nearest_in(phases_[i], corner.point));
      }
      // Corners by themselves have their middle at the middle, the quarter or an end of a phase; the others anywhere.
      EXPECT_LE(nearest, corner.corner_distance * (1 + 1e-6) + 16 * rounding_ + 1e-12);
    }
  }

  const Case& problem_;
  const Plan& plan_;
  std::vector<planning::Segment> segments_;
  std::vector<Phase> phases_;
  double rounding_ = 1e-15;
};

}  // namespace

void judge(const Case& problem, const Plan& plan) { Judge(problem, plan).run(); }

}  // namespace kcs::test
