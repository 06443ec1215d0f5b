#include "server/planning/uninterrupted.h"

#include <algorithm>
#include <cmath>

#include "server/motion/jlap.h"
#include "server/planning/search.h"

namespace kcs::planning {
namespace {

// Where the feed caps the corner. Arriving at V while braking with Ac, the tool must have been faster by Ac²/(2J) on
// the leg, and that must not exceed the feed. (The paper sets V to the feed, which would.) So V and Ac are a
// compromise: the softer the braking, the nearer V to the feed, but the longer the corner.
class FeedCappedCorner {
 public:
  FeedCappedCorner(const CornerGeometry& corner, double max_acceleration, double corner_jerk)
      : corner_(corner), max_acceleration_(max_acceleration), corner_jerk_(corner_jerk) {}

  // The hardest braking that speed V leaves room for, mm/s².
  double acceleration(double speed) const {
    const auto room = [speed](const Leg& leg) { return std::sqrt(2 * leg.jerk * std::max(0.0, leg.feed - speed)); };
    return std::min({max_acceleration_, std::sqrt(2 * speed * corner_jerk_), room(corner_.in), room(corner_.out)});
  }

  // Middle of the corner to its point, mm. Grows with the speed.
  double cut(double speed) const { return speed * speed * corner_.half_sine / (6 * acceleration(speed)); }

  // Time that the corner costs against passing it at the feed, s, up to where the acceleration has died away.
  double time_lost(double speed) const {
    const double a = acceleration(speed), duration = 2 * speed / a, length = speed * duration / 3;
    double lost = duration;
    for (const Leg* leg : {&corner_.in, &corner_.out}) {
      const motion::Ramp ramp = motion::ramp_to_peak(speed, a, leg->feed, leg->acceleration, leg->jerk);
      lost += ramp.duration - (ramp.distance + length) / leg->feed;
    }
    return lost;
  }

  // The speed that costs the least time and cuts the corner by at most the tolerance, mm/s.
  double best_speed() const {
    const double feed = std::min(corner_.in.feed, corner_.out.feed);
    const double fastest = largest_fitting(0, feed * (1 - 1e-9), 0, [&](double v) { return cut(v) - corner_.cut; });
    const double freest = largest_fitting(0, fastest, 0, [&](double v) {  // from here on the feed is what limits Ac
      return std::min(max_acceleration_, std::sqrt(2 * v * corner_jerk_)) - acceleration(v);
    });
    return least_argument(freest, fastest, [&](double v) { return time_lost(v); });
  }

 private:
  const CornerGeometry& corner_;
  double max_acceleration_;
  double corner_jerk_;
};

}  // namespace

Uninterrupted::Uninterrupted(const CornerGeometry& corner, const AxisLimits& limits)
    : half_sine_(corner.half_sine), jerk_(along(limits.jerk, corner.sum, limits.axes)) {
  const double axes_acceleration = std::min(corner.in.acceleration, corner.out.acceleration);
  const double k = corner.half_sine / (6 * corner.cut);
  max_speed_ = std::min(std::sqrt(axes_acceleration / k), std::cbrt(2 * jerk_ / (k * k)));
  max_acceleration_ = std::min(axes_acceleration, max_speed_ * max_speed_ * k);
  const double slack = max_acceleration_ * max_acceleration_ / 2;
  if (max_speed_ + slack / corner.in.jerk > corner.in.feed || max_speed_ + slack / corner.out.jerk > corner.out.feed) {
    const FeedCappedCorner capped(corner, axes_acceleration, jerk_);
    max_speed_ = capped.best_speed();
    max_acceleration_ = capped.acceleration(max_speed_);
  }
  // Near a reversal the corner itself hardly needs jerk. Slower than at the greatest speed, Ac must fade away with V
  // all the same, at the legs' pace, or short legs could not bring it about.
  jerk_ = std::min(jerk_, std::max(std::min(corner.in.jerk, corner.out.jerk),
                                   max_acceleration_ * max_acceleration_ / (2 * max_speed_)));
}

// As at the greatest speed, or what the jerk allows: so the cut and the length shrink with the speed.
double Uninterrupted::acceleration(double speed) const {
  return std::min(max_acceleration_, std::sqrt(2 * speed * jerk_));
}

CornerMotion Uninterrupted::at(double speed) const {
  if (speed == 0) return {};
  const double a = acceleration(speed);
  return {.speed = speed,
          .acceleration = a,
          .length = 2 * speed * speed / (3 * a),
          .duration = 2 * speed / a,
          .cut = speed * speed * half_sine_ / (6 * a)};
}

double Uninterrupted::speed_at_level(double level, double leg_jerk) const {
  // Where the jerk limits Ac: V + 2 V jerk/(2 J) = level.
  const double by_jerk = level / (1 + jerk_ / leg_jerk);
  if (2 * by_jerk * jerk_ <= max_acceleration_ * max_acceleration_) return by_jerk;
  return std::max(0.0, level - max_acceleration_ * max_acceleration_ / (2 * leg_jerk));
}

void Uninterrupted::append_phases(const CornerGeometry& corner, double speed,
                                  std::vector<motion::Phase>& phases) const {
  const CornerMotion motion = at(speed);
  motion::Phase phase{.duration = motion.duration,
                      .jerk = corner.sum * (motion.acceleration * motion.acceleration / (2 * speed))};
  phase.start.position = corner.in.end - motion.length * corner.in.direction;
  phase.start.velocity = speed * corner.in.direction;
  phase.start.acceleration = -motion.acceleration * corner.in.direction;
  phases.push_back(phase);
}

}  // namespace kcs::planning
