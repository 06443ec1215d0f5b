#include "server/planning/corner_plan.h"

#include <cstddef>
#include <utility>

#include "server/planning/leg_profile.h"
#include "server/planning/lookahead.h"

namespace kcs::planning {
namespace {

CornerPlan with_strategy(const LegPath& path, const PlanOptions& options, CornerStrategy strategy) {
  CornerPlan plan;
  plan.cornerings.resize(path.legs.size());
  for (std::size_t i = 0; i + 1 < path.legs.size(); ++i) {
    if (path.joints[i].stop) continue;
    const CornerGeometry corner = corner_geometry(path.legs[i], path.legs[i + 1], options);
    plan.cornerings[i] = choose_cornering(corner, strategy, options.limits);
  }
  plan.speeds = corner_speeds(path.legs, plan.cornerings);
  return plan;
}

// Without dwells, s.
double travel_time(const LegPath& path, const CornerPlan& plan) {
  double time = 0;
  CornerMotion entry;
  for (std::size_t i = 0; i < path.legs.size(); ++i) {
    const CornerMotion exit = plan.cornerings[i].at(plan.speeds[i]);
    time += leg_time(path.legs[i], entry, exit) + exit.duration;
    entry = exit;
  }
  return time;
}

}  // namespace

CornerPlan plan_corners(const LegPath& path, const PlanOptions& options) {
  CornerPlan best = with_strategy(path, options, options.strategy);
  if (options.strategy != CornerStrategy::kAuto) return best;
  double best_time = travel_time(path, best);
  for (const auto strategy :
       {CornerStrategy::kInterrupted, CornerStrategy::kUninterrupted, CornerStrategy::kExactStop}) {
    CornerPlan other = with_strategy(path, options, strategy);
    const double time = travel_time(path, other);
    if (time < best_time) {
      best = std::move(other);
      best_time = time;
    }
  }
  return best;
}

}  // namespace kcs::planning
