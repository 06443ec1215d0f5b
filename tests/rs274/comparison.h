// Whether a path follows the moves of a reference.
#pragma once

#include <string>

#include "server/planning/toolpath.h"
#include "tests/rs274/reference.h"

namespace kcs::test {

// Where `path` first differs from `moves` by more than 1e-6 mm or in the line that a move comes from: at the end of a
// line or an arc, in the centre, the radius, the height or the turns of an arc. Empty if it does not.
std::string difference(const planning::Toolpath& path, const std::vector<Move>& moves);

}  // namespace kcs::test
