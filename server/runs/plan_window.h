// The part of a plan that a run is in.
#pragma once

#include <cstddef>
#include <deque>

#include "server/motion/trajectory.h"

namespace kcs::runs {

// The phases of a trajectory from some time on, unpacked, so that they can be gone through again and again. Beyond its
// end the motion rests there. The trajectory must outlive the window. For one thread.
class PlanWindow {
 public:
  explicit PlanWindow(const motion::Trajectory& trajectory);

  // The number of the phase at `time` (s): the last one that has started by then. Quick where it is asked for times
  // near to each other.
  std::size_t find(double time);
  const motion::Phase& phase(std::size_t number);

  // Forgets what lies before `time`. Earlier times can be asked for all the same, at the price of unpacking them again.
  void drop_before(double time);

  double duration() const { return trajectory_.duration(); }  // of the plan, s

 private:
  void restart(double time);
  void read_one();

  const motion::Trajectory& trajectory_;
  motion::Trajectory::Iterator next_;
  motion::Phase rest_;
  std::deque<motion::Phase> phases_;
  std::size_t first_ = 0;  // number of the first one that is here
  std::size_t last_found_ = 0;
};

}  // namespace kcs::runs
