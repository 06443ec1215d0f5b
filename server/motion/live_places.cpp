#include "server/motion/live_places.h"

#include <algorithm>

#include "server/motion/setpoint.h"

namespace kcs::motion {

void LivePlaces::add(const Phase& phase) {
  phases_.push_back(phase);
  if (phases_.size() == 1) progress_.follow(phase);
  // No setpoint falls into a phase that has ended before the next one's time.
  go_to(setpoint_time(given_, period_));
}

Place LivePlaces::next() {
  const double time = setpoint_time(given_++, period_);
  go_to(time);
  return progress_.at(std::min(time - phases_.front().start_time, phases_.front().duration));
}

void LivePlaces::go_to(double time) {
  while (phases_.size() > 1 && time >= phases_.front().end_time()) {
    phases_.pop_front();
    progress_.follow(phases_.front());
    path_.forget_before(progress_.first_needed());
  }
}

}  // namespace kcs::motion
