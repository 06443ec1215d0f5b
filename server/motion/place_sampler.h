// The places on the path that belong to the setpoints of a trajectory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "server/motion/progress.h"
#include "server/motion/trajectory.h"

namespace kcs::motion {

// Tells the progress at the times i × period, as Sampler does the motion: place i depends on trajectory, path, period
// and i alone. Going on to higher indices costs constant time a phase and a place; jumping costs that of 64 phases.
class PlaceSampler {
 public:
  // milestones: all that Progress found along the trajectory. The three must outlive the sampler.
  PlaceSampler(const Trajectory& trajectory, const Path& path, const std::vector<Milestone>& milestones, double period);

  // The place of setpoint `index`, as Sampler counts them.
  Place at(std::uint64_t index);

 private:
  void go_to(double time);

  const Path& path_;
  const std::vector<Milestone>& milestones_;
  double period_;
  std::uint64_t count_;  // of setpoints
  // Where the last place was found: its phase, what came of the path until then, and the milestone after it.
  Trajectory::Iterator phase_;
  std::optional<Progress> progress_;
  std::size_t next_ = 0;
};

}  // namespace kcs::motion
