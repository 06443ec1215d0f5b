// Samples of a motion, and which there are.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "server/motion/phase.h"

namespace kcs::motion {

// One sample of a motion.
struct Setpoint {
  State state;
  Vector jerk = Vector::Zero();  // mm/s³; where two phases meet, that of the later one
};

// Setpoint i belongs to the time i × period.
inline double setpoint_time(std::uint64_t index, double period) { return static_cast<double>(index) * period; }

// How many setpoints a motion has; the last one is its exact end. duration and period: s; period > 0.
inline std::uint64_t setpoint_count(double duration, double period) {
  // A duration that is a whole number of periods but for its rounding gets no extra setpoint.
  return static_cast<std::uint64_t>(std::ceil(duration / period * (1 - 1e-12))) + 1;
}

// The setpoint at `time` (s), which falls into `phase`.
inline Setpoint setpoint_in(const Phase& phase, double time) {
  return {phase.at(std::min(time - phase.start_time, phase.duration)), phase.jerk};
}

}  // namespace kcs::motion
