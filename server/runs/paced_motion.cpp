#include "server/runs/paced_motion.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "server/motion/verifier.h"
#include "server/runs/polynomial.h"

namespace kcs::runs {
namespace {

class Judge {
 public:
  Judge(const motion::Phase& phase, const ClockState& start, double bend, double duration)
      : duration_(duration),
        along_{start.plan_time - phase.start_time, start.rate, start.rate_change / 2, bend / 6},
        rate_{start.rate, start.rate_change, bend / 2},
        rate_change_{start.rate_change, bend},
        bend_{bend},
        phase_(phase) {}

  // Nothing, or the word for what goes beyond its limit.
  const char* judge(Eigen::Index axis, const motion::AxisLimits& limits) const {
    const double v0 = phase_.start.velocity[axis], a0 = phase_.start.acceleration[axis], j0 = phase_.jerk[axis];
    const Polynomial acceleration = Polynomial{a0} + j0 * along_;
    const Polynomial velocity = Polynomial{v0} + a0 * along_ + (j0 / 2) * (along_ * along_);
    const Polynomial square = rate_ * rate_;
    if (!within(velocity * rate_, limits.velocity[axis])) return "velocity";
    if (!within(acceleration * square + velocity * rate_change_, limits.acceleration[axis])) return "acceleration";
    if (!within(j0 * (square * rate_) + 3 * (acceleration * (rate_ * rate_change_)) + velocity * bend_,
                limits.jerk[axis])) {
      return "jerk";
    }
    return nullptr;
  }

 private:
  bool within(const Polynomial& value, double limit) const {
    return value.is_within(limit * (1 + motion::kRoundingShare), duration_);
  }

  double duration_;
  Polynomial along_, rate_, rate_change_, bend_;
  const motion::Phase& phase_;
};

}  // namespace

std::string verify(PlanWindow& plan, const ClockPhase& clock, const motion::AxisLimits& limits) {
  const double end = clock.end().plan_time;
  double from = 0;
  for (std::size_t number = plan.find(clock.start.plan_time);; ++number) {
    const motion::Phase& phase = plan.phase(number);
    const bool last = phase.end_time() >= end;
    const double to = last ? clock.duration : clock.time_of(phase.end_time(), from, clock.duration);
    const Judge judge(phase, clock.at(from), clock.bend, to - from);
    for (Eigen::Index axis = 0; axis < static_cast<Eigen::Index>(limits.axes); ++axis) {
      if (const char* beyond = judge.judge(axis, limits)) {
        return fmt::format("the {} of axis {} is beyond its limit at {} s of the plan", beyond, "XYZ"[axis],
                           clock.at(from).plan_time);
      }
    }
    if (last) return "";
    from = to;
  }
}

motion::Vector position(PlanWindow& plan, double plan_time) {
  const motion::Phase& phase = plan.phase(plan.find(plan_time));
  return phase.at(std::min(plan_time - phase.start_time, phase.duration)).position;
}

}  // namespace kcs::runs
