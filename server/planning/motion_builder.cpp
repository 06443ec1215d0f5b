#include "server/planning/motion_builder.h"

#include <algorithm>
#include <cmath>

#include "server/planning/leg_profile.h"

namespace kcs::planning {
namespace {

// A peak this near to the feed is the feed.
constexpr double kAtFeed = 1 - 1e-6;

motion::Phase on_line(const Vector& origin, const Vector& direction, const motion::LinearState& state,
                      const motion::LinearPhase& phase) {
  return {.duration = phase.duration,
          .start = {origin + state.position * direction, state.velocity * direction, state.acceleration * direction},
          .jerk = phase.jerk * direction};
}

}  // namespace

void MotionBuilder::append(motion::Phase phase, const motion::SegmentRange& segments) {
  if (!(phase.duration > 0)) return;
  phase.start_time = time_;
  phase.segments = segments;
  time_ = phase.end_time();
  phases_.push_back(phase);
}

void MotionBuilder::dwell(const Vector& point, double duration, std::uint32_t segment) {
  append({.duration = duration, .start = {.position = point}}, {segment, segment});
}

LegTimes MotionBuilder::leg(const Leg& leg, const CornerMotion& entry, const CornerMotion& exit) {
  const LegEnd from = leg_end(entry, leg), to = leg_end(exit, leg);
  const double peak = peak_speed(leg, from, to, leg.length - entry.length - exit.length);
  const auto up = motion::jlap(from.speed, from.acceleration, peak, 0, leg.acceleration, leg.jerk);
  const auto down = motion::jlap(to.speed, to.acceleration, peak, 0, leg.acceleration, leg.jerk);

  double up_time = 0, down_time = 0;
  motion::LinearState state{entry.length, from.speed, from.acceleration};
  for (const motion::LinearPhase& phase : up) {
    append(on_line(leg.start, leg.direction, state, phase), leg.segments);
    state = phase.end(state);
    up_time += phase.duration;
  }
  // The way down is the way up from the far end, run backwards; reckoned from there, so that the end is met exactly.
  std::array<motion::LinearState, 4> back{motion::LinearState{exit.length, to.speed, to.acceleration}};
  for (std::size_t i = 0; i < down.size(); ++i) {
    back[i + 1] = down[i].end(back[i]);
    down_time += down[i].duration;
  }
  const double cruise = std::max(0.0, leg.length - state.position - back[3].position) / peak;
  append(on_line(leg.start, leg.direction, {state.position, peak, 0}, {cruise, 0}), leg.segments);
  for (std::size_t i = down.size(); i-- > 0;) {
    const motion::LinearState start{-back[i + 1].position, back[i + 1].velocity, -back[i + 1].acceleration};
    append(on_line(leg.end, leg.direction, start, {down[i].duration, down[i].jerk}), leg.segments);
  }

  const double cruise_lost = cruise * (1 - peak / leg.feed);
  return {.entry_lost = up_time - state.position / leg.feed + cruise_lost / 2,
          .exit_lost = down_time - back[3].position / leg.feed + cruise_lost / 2,
          .at_feed = peak >= leg.feed * kAtFeed ? cruise : 0};
}

void MotionBuilder::corner(const CornerGeometry& geometry, const Cornering& cornering, double speed) {
  scratch_.clear();
  cornering.append_phases(geometry, speed, scratch_);
  for (const motion::Phase& phase : scratch_) {
    append(phase, {geometry.in.segments.first, geometry.out.segments.last});
  }
}

void MotionBuilder::stretch(const Stretch& stretch) {
  for (std::size_t i = stretch.first_piece(); i < stretch.pieces().size(); ++i) {
    const motion::Phase phase = stretch.phase(i);
    append(phase, phase.segments);
  }
}

motion::LinearState MotionBuilder::settle(const Leg& leg, const motion::LinearState& start) {
  const motion::LinearPhase phase{std::abs(start.acceleration) / leg.jerk,
                                  std::copysign(leg.jerk, -start.acceleration)};
  append(on_line(leg.start, leg.direction, start, phase), leg.segments);
  return {phase.end(start).position, phase.end(start).velocity, 0};
}

}  // namespace kcs::planning
