// Setpoints of a trajectory at a fixed period, computed when they are asked for.
#pragma once

#include <cstddef>
#include <cstdint>

#include "server/motion/setpoint.h"
#include "server/motion/trajectory.h"

namespace kcs::motion {

// Samples a trajectory at the times i × period. The last setpoint is the exact end; it belongs to the first multiple of
// the period that is not before the end.
// Setpoint i depends on the trajectory, the period and i alone, so any part of the sequence can be computed again.
// Going on to higher indices costs constant time a setpoint; jumping costs a binary search.
// The trajectory must outlive the sampler. Not for use by two threads at once; each takes its own.
class Sampler {
 public:
  // period: s, > 0.
  Sampler(const Trajectory& trajectory, double period);

  // Number of setpoints, at least 1.
  std::uint64_t count() const { return count_; }

  // Setpoint `index`; index < count().
  Setpoint at(std::uint64_t index);

 private:
  State final_state_;
  double period_;
  std::uint64_t count_;
  Trajectory::Iterator phase_;  // where the last setpoint was found
};

}  // namespace kcs::motion
