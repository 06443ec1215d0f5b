#include "server/motion/sampler.h"

#include <algorithm>
#include <cmath>

namespace kcs::motion {

Sampler::Sampler(const Trajectory& trajectory, double period)
    : trajectory_(trajectory),
      period_(period),
      // A duration that is a whole number of periods but for its rounding gets no extra setpoint.
      count_(static_cast<std::uint64_t>(std::ceil(trajectory.duration() / period * (1 - 1e-12))) + 1) {}

Setpoint Sampler::at(std::uint64_t index) {
  const auto& phases = trajectory_.phases;
  if (index + 1 >= count_ || phases.empty()) return {State{.position = trajectory_.end}, Vector::Zero()};
  const double time = static_cast<double>(index) * period_;
  if (time < phases[phase_].start_time || (phase_ + 64 < phases.size() && time >= phases[phase_ + 64].start_time)) {
    const auto after = std::upper_bound(phases.begin(), phases.end(), time,
                                        [](double t, const Phase& phase) { return t < phase.start_time; });
    phase_ = static_cast<std::size_t>(after - phases.begin()) - 1;
  }
  while (phase_ + 1 < phases.size() && time >= phases[phase_ + 1].start_time) ++phase_;
  const Phase& phase = phases[phase_];
  return {phase.at(std::min(time - phase.start_time, phase.duration)), phase.jerk};
}

}  // namespace kcs::motion
