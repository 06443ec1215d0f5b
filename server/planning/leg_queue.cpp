#include "server/planning/leg_queue.h"

#include <algorithm>

namespace kcs::planning {
namespace {

// A leg is no longer than this, so that what is kept of the path stays bounded; on a line, legs join without a corner.
constexpr std::uint32_t kMostSegments = 10'000;

// What a straight run means for a machine and a programmed feed.
Leg leg_on(const motion::StraightRun& run, const AxisLimits& limits, const Segment& like,
           const motion::SegmentRange& segments) {
  const Vector& direction = run.direction();
  return {.start = run.start(),
          .end = run.end(),
          .direction = direction,
          .length = run.length(),
          .tolerance = like.tolerance,
          .programmed_feed = like.feed,
          .feed = std::min(like.feed, along(limits.velocity, direction, limits.axes)),
          .acceleration = along(limits.acceleration, direction, limits.axes),
          .jerk = along(limits.jerk, direction, limits.axes),
          .segments = segments};
}

}  // namespace

bool LegQueue::add(const Segment& segment) {
  if ((segment.end - end_).norm() < kNoLength) {  // nothing to move, but perhaps to wait for
    if (legs_.empty()) {
      initial_stop_ |= segment.stop || segment.dwell > 0;
      initial_dwell_ += segment.dwell;
    } else {
      joints_.back().stop |= segment.stop || segment.dwell > 0;
      joints_.back().dwell += segment.dwell;
    }
    return false;
  }
  const std::uint32_t index = segments();
  const bool same_leg = run_ && !joints_.back().stop && last_.feed == segment.feed &&
                        last_.tolerance == segment.tolerance && index - legs_.back().segments.first < kMostSegments &&
                        run_->extend(segment.end);
  if (!same_leg) {
    run_.emplace(end_, segment.end);
    legs_.push_back({.segments = {index, index}});
    joints_.emplace_back();
  }
  legs_.back() = leg_on(*run_, limits_, segment, {legs_.back().segments.first, index});
  joints_.back() = {segment.stop || segment.dwell > 0, segment.dwell, segment.line};
  ends_.push_back(segment.end);
  end_ = segment.end;
  last_ = segment;
  return true;
}

LegPath LegQueue::first(std::size_t count) const {
  const auto part = static_cast<std::ptrdiff_t>(count);
  return {{legs_.begin(), legs_.begin() + part}, {joints_.begin(), joints_.begin() + part}};
}

void LegQueue::drop(std::size_t count) {
  for (; count > 0; --count) {
    const std::uint32_t next = legs_.front().segments.last + 1;
    ends_.erase(ends_.begin(), ends_.begin() + (next - first_segment_));
    first_segment_ = next;
    legs_.pop_front();
    joints_.pop_front();
  }
}

}  // namespace kcs::planning
