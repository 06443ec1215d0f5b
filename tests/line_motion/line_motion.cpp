#include "tests/line_motion/line_motion.h"

#include <algorithm>
#include <cmath>

namespace kcs::test {
namespace {

// What it takes to change the velocity from rest by so much.
double time_to_reach(double velocity, const LineLimits& limits) {
  const double whole = limits.acceleration * limits.acceleration / limits.jerk;
  if (velocity >= whole) return velocity / limits.acceleration + limits.acceleration / limits.jerk;
  return 2 * std::sqrt(velocity / limits.jerk);
}

LineState after(const LineState& start, double jerk, double t) {
  return {.place = start.place + t * (start.velocity + t * (start.acceleration / 2 + t * jerk / 6)),
          .velocity = start.velocity + t * (start.acceleration + t * jerk / 2),
          .acceleration = start.acceleration + t * jerk};
}

}  // namespace

void LineMotion::add(double duration_s, double jerk) {
  const LineState start = after(pieces_.back().start, pieces_.back().jerk, duration_ - pieces_.back().begin_s);
  pieces_.push_back({.begin_s = duration_, .start = start, .jerk = jerk});
  duration_ += duration_s;
}

LineState LineMotion::at(double time_s) const {
  const bool rests = time_s >= duration_;
  const double t = std::clamp(time_s, 0.0, duration_);
  const auto next = std::upper_bound(pieces_.begin(), pieces_.end(), t,
                                     [](double time, const Piece& piece) { return time < piece.begin_s; });
  const Piece& piece = *std::prev(next);
  const LineState state = after(piece.start, piece.jerk, t - piece.begin_s);
  return rests ? LineState{.place = state.place} : state;
}

LineMotion LineMotion::travel(double from, double to, const LineLimits& limits) {
  const double distance = to - from;
  double velocity = limits.velocity;
  if (velocity * time_to_reach(velocity, limits) > distance) {
    double low = 0;
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + velocity) / 2;
      (middle * time_to_reach(middle, limits) > distance ? velocity : low) = middle;
    }
    velocity = low;
  }
  const double change = time_to_reach(velocity, limits);
  const double jerking = std::min(change / 2, limits.acceleration / limits.jerk);
  LineMotion motion({.place = from});
  for (const double sign : {1.0, -1.0}) {
    motion.add(jerking, sign * limits.jerk);
    motion.add(change - 2 * jerking, 0);
    motion.add(jerking, -sign * limits.jerk);
    if (sign > 0 && velocity > 0) motion.add(std::max(0.0, distance / velocity - change), 0);
  }
  return motion;
}

LineMotion LineMotion::stop(const LineState& state, const LineLimits& limits) {
  const double a = state.acceleration;
  // What braking has to take away, and the acceleration at its height: more than there is already.
  const double change = std::max(0.0, state.velocity + a * a / (2 * limits.jerk));
  const double peak = std::max(-a, std::min(limits.acceleration, std::sqrt(limits.jerk * change)));
  LineMotion motion(state);
  motion.add((a + peak) / limits.jerk, -limits.jerk);
  if (peak > 0) motion.add(std::max(0.0, (change - peak * peak / limits.jerk) / peak), 0);
  motion.add(peak / limits.jerk, limits.jerk);
  return motion;
}

std::array<double, 3> Line::at(double place) const {
  return {origin[0] + place * direction[0], origin[1] + place * direction[1], origin[2] + place * direction[2]};
}

double Line::place_of(const double* position_mm) const {
  double place = 0;
  for (int axis = 0; axis < 3; ++axis) place += (position_mm[axis] - origin[axis]) * direction[axis];
  return place;
}

double Line::distance_to(const double* position_mm) const {
  const std::array<double, 3> nearest = at(place_of(position_mm));
  return std::hypot(position_mm[0] - nearest[0], position_mm[1] - nearest[1], position_mm[2] - nearest[2]);
}

kcs_player_profile Line::profile(const LineLimits& limits, double period_s) const {
  kcs_player_profile profile{};
  profile.axes = 3;
  profile.period_s = period_s;
  for (int axis = 0; axis < 3; ++axis) {
    const double share = std::abs(direction[axis]);
    profile.velocity_mm_s[axis] = limits.velocity * share;
    profile.acceleration_mm_s2[axis] = limits.acceleration * share;
    profile.jerk_mm_s3[axis] = limits.jerk * share;
    profile.following_error_mm[axis] = 1;
  }
  return profile;
}

void LineRun::begin(std::uint64_t run, std::uint64_t branch, std::uint64_t first_tick, double place) {
  run_ = run;
  branch_ = branch;
  first_tick_ = first_tick;
  ticks_ = 0;
  motion_ = LineMotion::travel(place, length_, limits_);
  over_ = false;
}

void LineRun::write(kcs_player_batch& batch) {
  batch.run = run_;
  batch.branch = branch_;
  batch.first_tick = first_tick_ + ticks_;
  unsigned count = 0;
  const auto append = [&](double place) {
    const std::array<double, 3> position = line_.at(place);
    std::copy(position.begin(), position.end(), batch.position_mm[count++]);
  };
  LineState state;
  do {
    ++ticks_;
    const double time = static_cast<double>(ticks_) * period_s_;
    state = motion_.at(time);
    over_ = time >= motion_.duration_s();
    append(state.place);
  } while (!over_ && count < batch_);
  batch.setpoints = count;
  batch.tail = 0;
  batch.last = over_ ? 1 : 0;
  batch.marker_count = 0;
  if (over_) return;
  const LineMotion tail = LineMotion::stop(state, limits_);
  for (double time = period_s_; time < tail.duration_s() + period_s_; time += period_s_) append(tail.at(time).place);
  batch.tail = count - batch.setpoints;
}

}  // namespace kcs::test
