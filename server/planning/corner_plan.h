// How every corner of a path is taken, and how fast.
#pragma once

#include <vector>

#include "server/planning/cornering.h"
#include "server/planning/leg.h"
#include "server/planning/options.h"

namespace kcs::planning {

// Both have one entry per leg, for the joint at its end; the path ends with an exact stop.
struct CornerPlan {
  std::vector<Cornering> cornerings;
  std::vector<double> speeds;  // mm/s
};

// With kAuto each corner is given the strategy that suits it by itself, and the path as a whole is never slower than
// with one and the same strategy at all of its corners.
CornerPlan plan_corners(const LegPath& path, const PlanOptions& options);

}  // namespace kcs::planning
