// What a stretch does at the corners that it passes.
#pragma once

#include <vector>

#include "server/planning/plan.h"
#include "server/planning/stretch.h"

namespace kcs::planning {

// What a stretch loses against the feed before its first corner and after its last one, s, and its time at the feed, s.
struct StretchTimes {
  double entry_lost = 0;
  double exit_lost = 0;
  double at_feed = 0;
};

// Adds a record for each corner inside the stretch to `corners`: where the tool is nearest to it. What is lost counts
// from the middle of one leg to the middle of the next. joints: those of the whole path; first_leg: of the stretch.
StretchTimes add_corners(const Stretch& stretch, const std::vector<Joint>& joints, std::size_t first_leg,
                         const PlanOptions& options, std::vector<Corner>& corners);

}  // namespace kcs::planning
