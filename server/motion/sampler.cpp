#include "server/motion/sampler.h"

namespace kcs::motion {

Sampler::Sampler(const Trajectory& trajectory, double period)
    : final_state_(trajectory.final_state()),
      period_(period),
      count_(setpoint_count(trajectory.duration(), period)),
      phase_(trajectory.begin()) {}

Setpoint Sampler::at(std::uint64_t index) {
  if (index + 1 >= count_) return {final_state_, Vector::Zero()};
  const double time = setpoint_time(index, period_);
  if (time < phase_->start_time || time >= phase_->end_time()) phase_.seek(time);
  return setpoint_in(*phase_, time);
}

}  // namespace kcs::motion
