// Does the tool turn round on its path?
#pragma once

#include <span>

#include "server/motion/course.h"
#include "server/motion/phase.h"

namespace kcs::motion {

// How fast the tool goes back in a phase, which ends in `end`, mm/s: against every one of the pieces at the same time,
// by more than `slowest`. 0: it does not.
double speed_back(const Phase& phase, const State& end, std::span<const Piece> pieces, double slowest);

}  // namespace kcs::motion
