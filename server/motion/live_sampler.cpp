#include "server/motion/live_sampler.h"

namespace kcs::motion {

void LiveSampler::add(const Phase& phase) {
  phases_.push_back(phase);
  count_ = setpoint_count(phase.end_time(), period_);
  // No setpoint falls into a phase that has ended before the next one's time.
  const double time = setpoint_time(given_, period_);
  while (phases_.size() > 1 && time >= phases_.front().end_time()) phases_.pop_front();
}

std::optional<Setpoint> LiveSampler::next() {
  if (given_ + 1 >= count_) {
    if (!final_state_ || ended_) return {};
    ended_ = true;
    ++given_;
    return Setpoint{*final_state_};
  }
  const double time = setpoint_time(given_++, period_);
  while (time >= phases_.front().end_time()) phases_.pop_front();
  return setpoint_in(phases_.front(), time);
}

}  // namespace kcs::motion
