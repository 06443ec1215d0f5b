// Judges what the drives were commanded, by nothing else than that.
#pragma once

#include <string>
#include <vector>

#include "client/gateway/player/player.h"
#include "client/gateway/vector.h"

namespace kcs::gateway {

// What is wrong with the commands of a run along StraightMotion's path; empty: nothing. They must begin at rest at its
// start and end at rest at `length_mm`, keep the machine's limits in every difference, stay on the path, and never go
// back on it, for then something would be travelled twice.
std::string find_violation(const std::vector<Vector>& commands, const kcs_player_profile& profile, double length_mm);

}  // namespace kcs::gateway
