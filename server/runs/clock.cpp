#include "server/runs/clock.h"

#include <algorithm>

namespace kcs::runs {

double ClockPhase::lowest_rate() const {
  const double turning = bend > 0 ? std::clamp(-start.rate_change / bend, 0.0, duration) : 0;
  return std::min({start.rate, at(turning).rate, end().rate});
}

double ClockPhase::time_of(double plan_time, double low, double high) const {
  double time = low + (high - low) / 2;
  for (int i = 0; i < 100 && high > low; ++i) {
    const ClockState state = at(time);
    (state.plan_time < plan_time ? low : high) = time;
    double next = state.rate > 0 ? time + (plan_time - state.plan_time) / state.rate : low;
    if (!(next > low && next < high)) next = low + (high - low) / 2;
    if (next == time) break;
    time = next;
  }
  return time;
}

}  // namespace kcs::runs
