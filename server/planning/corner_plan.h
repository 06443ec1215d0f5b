// How every corner of a path is taken, and how fast.
#pragma once

#include <vector>

#include "server/planning/leg.h"
#include "server/planning/options.h"
#include "server/planning/stage.h"

namespace kcs::planning {

struct CornerPlan {
  std::vector<Stage> stages;
  std::vector<double> speeds;  // at the end of each stage, mm/s
};

CornerPlan plan_corners(const LegPath& path, const PlanOptions& options);

}  // namespace kcs::planning
