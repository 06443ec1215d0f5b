#include "server/motion/sampler.h"

#include <algorithm>
#include <cmath>

namespace kcs::motion {

Sampler::Sampler(const Trajectory& trajectory, double period)
    : final_state_(trajectory.final_state()),
      period_(period),
      // A duration that is a whole number of periods but for its rounding gets no extra setpoint.
      count_(static_cast<std::uint64_t>(std::ceil(trajectory.duration() / period * (1 - 1e-12))) + 1),
      phase_(trajectory.begin()) {}

Setpoint Sampler::at(std::uint64_t index) {
  if (index + 1 >= count_) return {final_state_, Vector::Zero()};
  const double time = static_cast<double>(index) * period_;
  if (time < phase_->start_time || time >= phase_->end_time()) phase_.seek(time);
  return {phase_->at(std::min(time - phase_->start_time, phase_->duration)), phase_->jerk};
}

}  // namespace kcs::motion
