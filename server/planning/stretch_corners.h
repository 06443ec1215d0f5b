// What a stretch does at the corners that it passes.
#pragma once

#include <vector>

#include "server/planning/corner.h"
#include "server/planning/stretch.h"

namespace kcs::planning {

// What a stretch loses against the feed before its first corner and after its last one, s, and its time at the feed, s.
struct StretchTimes {
  double entry_lost = 0;  // if it begins in this part
  double exit_lost = 0;   // if it ends in this part
  double at_feed = 0;
};

// The first corner inside the stretch that has no record yet when its first so many pieces are settled (0: no more than
// were settled before): the tool has not come to the middle of the leg after it, or may still come nearer to it.
std::size_t first_unreported(const Stretch& stretch, std::size_t pieces);

// Appends a record of each corner that has none when the first `from` pieces are settled, but has one when the first
// `to` pieces are: where the tool is nearest to it. What is lost counts from the middle of one leg to the middle of the
// next. joints: those of the whole path; first_leg: of the stretch.
StretchTimes add_corners(const Stretch& stretch, std::size_t from, std::size_t to, const std::vector<Joint>& joints,
                         std::size_t first_leg, const PlanOptions& options, std::vector<Corner>& corners);

}  // namespace kcs::planning
