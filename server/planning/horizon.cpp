#include "server/planning/horizon.h"

#include <algorithm>
#include <cmath>

#include "server/motion/jlap.h"
#include "server/planning/range.h"
#include "server/planning/smooth_motion.h"

namespace kcs::planning {
namespace {

// What is settled at a time: so many steps of time (smooth_motion.h), and legs, at least. Both make planning wait for
// the path, and the second keeps short programs whole.
constexpr double kSettledSteps = 600, kSettledLegs = 64;
// What is looked at beyond it: kStepsAhead and so many legs at least, and as often as far as the tool needs to stop.
constexpr double kLegsAhead = 8, kStopsAhead = 3;
// Where legs are so short, or of so many segments, that these would be more, this is enough of them.
constexpr double kMostSegments = 20'000;
// The same of steps at the speeds that bends allow: what is settled and what is looked at are planned in one motion,
// which may not have more points (kMostPoints).
constexpr double kMostSettledSteps = 0.6 * kMostPoints, kMostStepsAhead = 0.4 * kMostPoints;

// A leg of no more steps than this may be part of a dense stretch, whose steps are longer.
constexpr double kDenseSteps = 6;
// A sharp corner costs so many steps more than what the feed asks for. Sections of very many points would take long to
// plan, and hardly be found.
constexpr double kCornerSteps = 12;

// A bend may be taken so many times as fast as if the path were an arc between the middles of its legs, and is spread
// over so many tolerances: rather too fast than too slow.
constexpr double kFaster = 2, kSpread = 4;

double square(double value) { return value * value; }

double likely_acceleration(const Vector& direction, const motion::AxisLimits& limits) {
  return roughly_along(limits.acceleration, direction, limits.axes);
}

// mm/s, squared.
double square_speed_of_bend(const Leg& in, const Leg& out, const motion::AxisLimits& limits) {
  const Vector turn = out.direction - in.direction;
  const double length = (in.length + out.length) / 2 + kSpread * std::min(in.tolerance, out.tolerance);
  return square(kFaster) * likely_acceleration(turn.normalized(), limits) * length / turn.norm();
}

// Along a leg, mm.
double stopping_way(double speed, const Leg& leg, const motion::AxisLimits& limits) {
  return motion::ramp_to_peak(0, 0, speed, likely_acceleration(leg.direction, limits),
                              roughly_along(limits.jerk, leg.direction, limits.axes))
      .distance;
}

double tolerance_of(const Leg& leg) { return leg.tolerance > 0 ? leg.tolerance : range::kMaxTolerance; }

}  // namespace

bool Horizon::in_sight(const LegQueue& queue) {
  while (!beyond()) {
    if (legs_ == queue.size()) {
      if (queue.finished() && !ahead_) until_ = legs_ - 1;
      return queue.finished();
    }
    see(queue.leg(legs_));
  }
  return legs_ < queue.size() || queue.finished();
}

void Horizon::see(const Leg& leg) {
  ++legs_;
  segments_ += leg.segments.last - leg.segments.first + 1;
  way_ += leg.length;
  steps_ += steps_of(leg);
  reach(leg);
  if (ahead_) return look_farther(leg);
  const auto seen = static_cast<double>(legs_);
  ahead_ = (steps_ >= share_ * settled_ * kSettledSteps && seen >= share_ * kSettledLegs) ||
           segments_ >= share_ * kMostSegments || slow_steps_ >= share_ * settled_ * kMostSettledSteps;
  if (!ahead_) return;
  until_ = legs_ - 1;
  steps_ = slow_steps_ = way_ = segments_ = 0;
  first_feed_ = leg.feed;
  look_farther(leg);
}

// How fast the tool may be on a leg, from the feed on the first one.
void Horizon::reach(const Leg& leg) {
  if (last_leg_) {
    const double before = std::min(square(speed_), square_speed_of_bend(*last_leg_, leg, limits_));
    speed_ = std::min(leg.feed, std::sqrt(before + 2 * likely_acceleration(leg.direction, limits_) * leg.length));
  } else {
    speed_ = leg.feed;
  }
  last_leg_ = leg;
  const double steps = leg.length / speed_ / step_of_time(tolerance_of(leg), limits_);
  if (steps < kMostSteps) slow_steps_ += steps;  // else it is no part of a motion through many corners
}

// The tool may have to stop on legs along which it brakes more slowly.
void Horizon::look_farther(const Leg& leg) {
  stopping_way_ = std::max(stopping_way_, stopping_way(first_feed_, leg, limits_));
}

double Horizon::steps_of(const Leg& leg) {
  const double tolerance = tolerance_of(leg);
  const double time = leg.length / leg.feed, steps = time / step_of_time(tolerance, limits_);
  const double at_feed = steps > kDenseSteps ? steps : time / long_step_of_time(tolerance, limits_);
  return at_feed + (turns_.before(leg) ? kCornerSteps : 0);
}

bool Horizon::beyond() const {
  if (!ahead_ || legs_ < at_least_) return false;
  const auto seen = static_cast<double>(legs_ - until_ - 1);
  return (steps_ >= share_ * kStepsAhead && seen >= share_ * kLegsAhead &&
          way_ >= share_ * kStopsAhead * stopping_way_) ||
         segments_ >= share_ * kMostSegments || slow_steps_ >= share_ * kMostStepsAhead;
}

}  // namespace kcs::planning
