#include "server/planning/horizon.h"

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
// Where legs are so short that these would be more, this is enough of them.
constexpr double kMostLegs = 20'000;

// A leg of no more steps than this may be part of a dense stretch, whose steps are longer.
constexpr double kDenseSteps = 6;
// A sharp corner costs so many steps more than what the feed asks for. Sections of very many points would take long to
// plan, and hardly be found.
constexpr double kCornerSteps = 12;

// From the feed, along the axes' slowest direction, mm.
double stopping_way(double feed, const motion::AxisLimits& limits) {
  const auto axes = static_cast<Eigen::Index>(limits.axes);
  return motion::ramp_to_peak(0, 0, feed, limits.acceleration.head(axes).minCoeff(), limits.jerk.head(axes).minCoeff())
      .distance;
}

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
  way_ += leg.length;
  steps_ += steps_of(leg);
  if (ahead_) return;
  const auto seen = static_cast<double>(legs_);
  ahead_ = (steps_ >= share_ * settled_ * kSettledSteps && seen >= share_ * kSettledLegs) || seen >= share_ * kMostLegs;
  if (!ahead_) return;
  until_ = legs_ - 1;
  steps_ = way_ = 0;
  stopping_way_ = stopping_way(leg.feed, limits_);
}

double Horizon::steps_of(const Leg& leg) {
  const double tolerance = leg.tolerance > 0 ? leg.tolerance : range::kMaxTolerance;
  const double time = leg.length / leg.feed, steps = time / step_of_time(tolerance, limits_);
  const double at_feed = steps > kDenseSteps ? steps : time / long_step_of_time(tolerance, limits_);
  return at_feed + (turns_.before(leg) ? kCornerSteps : 0);
}

bool Horizon::beyond() const {
  if (!ahead_ || legs_ < at_least_) return false;
  const auto seen = static_cast<double>(legs_ - until_ - 1);
  return (steps_ >= share_ * kStepsAhead && seen >= share_ * kLegsAhead &&
          way_ >= share_ * kStopsAhead * stopping_way_) ||
         seen >= share_ * kMostLegs;
}

}  // namespace kcs::planning
