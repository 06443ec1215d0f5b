// How the corners of a part of a path are taken, and how fast.
#pragma once

#include <optional>
#include <vector>

#include "server/planning/entry.h"
#include "server/planning/leg.h"
#include "server/planning/options.h"
#include "server/planning/stage.h"

namespace kcs::planning {

struct CornerPlan {
  std::vector<Stage> stages;
  std::vector<CornerNeeds> needs;  // of each joint but the last
  std::vector<double> speeds;      // at the end of each stage, mm/s
  bool taken_apart = false;        // for some stretch no motion was found: its corners are taken one by one
};

// From `entry` to the end of the path, there at end_speed (mm/s) or slower. Nothing, if no motion goes on from `entry`.
// `path` and `entry` must outlive the result.
std::optional<CornerPlan> plan_corners(const LegPath& path, const Entry& entry, double end_speed,
                                       const PlanOptions& options);

// The same, with stretches made faster (tightening.h); with kAuto, no slower than any other strategy throughout. For
// short paths: in long ones the differences even out, and planning so often takes too long.
std::optional<CornerPlan> compare_corners(const LegPath& path, const Entry& entry, double end_speed,
                                          const PlanOptions& options);

}  // namespace kcs::planning
