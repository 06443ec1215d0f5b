// Corner speeds for which every leg's motion exists.
#pragma once

#include <span>
#include <vector>

#include "server/planning/cornering.h"
#include "server/planning/leg.h"

namespace kcs::planning {

// cornerings[i]: how the joint at the end of legs[i] is taken; one per leg, the last one an exact stop. The path begins
// at rest. Returns a speed for each joint, mm/s, at most the cornering's greatest, such that every leg is long enough
// for its two corners and the motion between them. Linear in the number of legs, in three passes: each leg's corners
// are lowered together until the leg could carry both at equal level; backward, each corner until the tool can brake to
// the next one; forward, until it can be reached from the one before. A lowered corner never makes another leg
// impossible, because needed_length grows with the common level, and with the faster corner's speed alone.
std::vector<double> corner_speeds(std::span<const Leg> legs, std::span<const Cornering> cornerings);

}  // namespace kcs::planning
