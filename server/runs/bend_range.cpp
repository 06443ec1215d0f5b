#include "server/runs/bend_range.h"

#include <algorithm>
#include <cmath>

namespace kcs::runs {
namespace {

constexpr double kSoon = 1e-9;  // s

class Narrowing {
 public:
  // phase: where the state is.
  Narrowing(const motion::AxisLimits& limits, const ClockState& state, const motion::Phase& phase, double share,
            double most)
      : limits_(limits), state_(state), share_(share), range_{-most, most} {
    const motion::State at = place(phase, state.plan_time);
    velocity_ = state.rate * at.velocity;
    acceleration_ = state.rate * state.rate * at.acceleration + state.rate_change * at.velocity;
  }

  // What the place of a phase that is reached after `time` leaves.
  void narrow(const motion::Phase& phase, double time) {
    const double rate = state_.rate + time * state_.rate_change;
    const double square = rate * rate, cube = square * rate, half_square = time * time / 2;
    const motion::State at = place(phase, state_.plan_time + time * state_.rate + half_square * state_.rate_change);
    for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(limits_.axes); ++i) {
      const double velocity = at.velocity[i], acceleration = at.acceleration[i], jerk = phase.jerk[i];
      // Each is c0 + c1 · bend, without the terms that are of second order in the bend.
      keep_within(most(limits_.velocity[i], velocity * rate, velocity_[i]), velocity * rate,
                  velocity * half_square + acceleration * rate * half_square * time / 3);
      // What the bend does to the acceleration comes with time: at the start it must not lead beyond a limit.
      keep_within(most(limits_.acceleration[i], acceleration * square, acceleration_[i]),
                  acceleration * square + velocity * state_.rate_change,
                  time == 0 ? velocity * kSoon : velocity * time + 2 * acceleration * rate * half_square);
      keep_within(most(limits_.jerk[i], jerk * cube, 0), jerk * cube + 3 * acceleration * rate * state_.rate_change,
                  velocity + 3 * acceleration * (rate * time + state_.rate_change * half_square) +
                      3 * jerk * square * half_square);
    }
  }

  const BendRange& range() const { return range_; }

 private:
  static motion::State place(const motion::Phase& phase, double plan_time) {
    return phase.at(std::clamp(plan_time - phase.start_time, 0.0, phase.duration));
  }

  // The share, or more where more is in use already: by the plan itself at a rate up to 1, which is inside the limit
  // for ever, or by the state.
  double most(double limit, double own, double used) const {
    const double most = std::max(share_ * limit, std::min(limit, std::abs(used)));
    return state_.rate <= 1 ? std::max(most, std::abs(own)) : most;
  }

  void keep_within(double most, double constant, double slope) {
    if (slope == 0) {
      if (std::abs(constant) > most) range_ = {1, -1};
      return;
    }
    const double one = (most - constant) / slope, other = (-most - constant) / slope;
    range_.low = std::max(range_.low, std::min(one, other));
    range_.high = std::min(range_.high, std::max(one, other));
  }

  const motion::AxisLimits& limits_;
  const ClockState& state_;
  double share_;
  motion::Vector velocity_, acceleration_;  // in use, mm/s and mm/s²
  BendRange range_;
};

// When the rate, changing as it does, has brought the plan on by `way`; not after `most`.
double time_to(double way, const ClockState& state, double most) {
  const double discriminant = state.rate * state.rate + 2 * state.rate_change * way;
  if (discriminant <= 0) return most;
  const double denominator = state.rate + std::sqrt(discriminant);
  return denominator > 0 ? std::clamp(2 * way / denominator, 0.0, most) : most;
}

}  // namespace

BendRange bend_range(PlanWindow& plan, const motion::AxisLimits& limits, const ClockState& state, double step,
                     double share, double most) {
  std::size_t number = plan.find(state.plan_time);
  Narrowing narrowing(limits, state, plan.phase(number), share, most);
  const double end = std::max(state.plan_time, ClockPhase{state, 0, step}.end().plan_time);
  double time = 0;
  for (;; ++number) {
    const motion::Phase& phase = plan.phase(number);
    const bool last = phase.end_time() >= end;
    const double to = last ? step : time_to(phase.end_time() - state.plan_time, state, step);
    narrowing.narrow(phase, time);
    narrowing.narrow(phase, (time + to) / 2);
    narrowing.narrow(phase, to);
    if (last || narrowing.range().empty()) return narrowing.range();
    time = to;
  }
}

}  // namespace kcs::runs
