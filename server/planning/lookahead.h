// Corner speeds for which the motion of every stage exists.
#pragma once

#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "server/planning/stage.h"

namespace kcs::planning {

// entry: how the tool comes onto the first leg. Returns a speed for the end of each stage, mm/s, at most its
// cornering's greatest, such that every leg is long enough for its two corners and the motion between them, and every
// stretch is planned with the speeds at its ends; or nothing, if the tool comes too fast. Linear in the number of
// stages, in three passes: each leg's corners are lowered together until the leg could carry both at equal level;
// backward, each corner until the tool can brake to the next one; forward, until it can be reached from the one before.
// A lowered corner never makes another leg impossible, because needed_length grows with the common level, and with the
// faster corner's speed alone. Throws Stopped.
std::optional<std::vector<double>> corner_speeds(std::span<const Stage> stages, const CornerMotion& entry,
                                                 const std::stop_token& stop);

}  // namespace kcs::planning
