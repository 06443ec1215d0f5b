// Where a motion passes from one piece of the path to the next.
#pragma once

#include <span>
#include <vector>

#include "server/motion/course.h"
#include "server/motion/phase.h"

namespace kcs::motion {

// The mitre of two pieces is the plane through their joint that halves the angle between them: on this side the first
// one is nearer, beyond it the second one.
// Writes to `times`, for each joint of `pieces`, when the phase passes its mitre: 0 if it begins beyond it, its
// duration if it ends before it; rising from joint to joint. Where a curve turns to and fro that is one of several
// answers: nothing may depend on it but the effort.
void pass_mitres(const Phase& phase, std::span<const Piece> pieces, std::vector<double>& times);

}  // namespace kcs::motion
