#include "server/planning/leg.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "server/motion/straight_run.h"

namespace kcs::planning {
namespace {

// What a straight run means for a machine and a programmed feed.
Leg leg_on(const motion::StraightRun& run, const AxisLimits& limits, const Segment& like,
           const motion::SegmentRange& segments) {
  const Vector& direction = run.direction();
  return {.start = run.start(),
          .end = run.end(),
          .direction = direction,
          .length = run.length(),
          .tolerance = like.tolerance,
          .feed = std::min(like.feed, along(limits.velocity, direction, limits.axes)),
          .acceleration = along(limits.acceleration, direction, limits.axes),
          .jerk = along(limits.jerk, direction, limits.axes),
          .segments = segments};
}

}  // namespace

double along(const Vector& limit, const Vector& direction, std::size_t axes) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t axis = 0; axis < axes; ++axis) {
    const double share = std::abs(direction[axis]);
    if (share > 0) smallest = std::min(smallest, limit[axis] / share);
  }
  return smallest;
}

LegPath legs_of(const Toolpath& path, const AxisLimits& limits) {
  LegPath result;
  result.points.push_back(path.start);
  std::optional<motion::StraightRun> run;  // of the last leg
  for (const Segment& segment : path.segments) {
    const Vector from = result.points.back();
    if ((segment.end - from).norm() < kNoLength) {  // nothing to move, but perhaps to wait for
      if (result.legs.empty()) {
        result.initial_dwell += segment.dwell;
      } else {
        result.joints.back().stop |= segment.stop || segment.dwell > 0;
        result.joints.back().dwell += segment.dwell;
      }
      continue;
    }
    const auto index = static_cast<std::uint32_t>(result.feeds.size());
    const bool same_leg = run && !result.joints.back().stop && result.feeds.back() == segment.feed &&
                          result.tolerances.back() == segment.tolerance && run->extend(segment.end);
    if (!same_leg) {
      run.emplace(from, segment.end);
      result.legs.push_back({.segments = {index, index}});
      result.joints.emplace_back();
    }
    result.legs.back() = leg_on(*run, limits, segment, {result.legs.back().segments.first, index});
    result.joints.back() = {segment.stop || segment.dwell > 0, segment.dwell, segment.line};
    result.points.push_back(segment.end);
    result.feeds.push_back(segment.feed);
    result.tolerances.push_back(segment.tolerance);
  }
  result.rests.assign(result.feeds.size(), -1);
  for (std::size_t i = 0; i < result.legs.size(); ++i) {
    if (result.joints[i].stop) result.rests[result.legs[i].segments.last] = result.joints[i].dwell;
  }
  return result;
}

}  // namespace kcs::planning
