// A motion from rest to rest, as a sequence of constant-jerk phases. Sampling, verification and plots read this type
// and need not know how it was made.
#pragma once

#include <vector>

#include "server/motion/phase.h"

namespace kcs::motion {

struct Trajectory {
  // In order of time, without gaps: each phase starts when and where the one before it ends.
  std::vector<Phase> phases;
  // Where the motion ends, exactly; the whole motion if there are no phases.
  Vector end = Vector::Zero();

  // s
  double duration() const { return phases.empty() ? 0 : phases.back().end_time(); }
};

}  // namespace kcs::motion
