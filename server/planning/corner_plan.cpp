#include "server/planning/corner_plan.h"

#include <cstddef>
#include <set>
#include <utility>

#include "server/planning/leg_profile.h"
#include "server/planning/lookahead.h"

namespace kcs::planning {
namespace {

// Up to so many legs, kAuto is compared with the other strategies throughout; in longer paths the differences even out,
// and planning four times takes too long.
constexpr std::size_t kCompared = 1000;

// A stretch that cannot be as slow at its ends as its neighbours ask is taken apart, and all is planned again, so
// often.
constexpr int kAttempts = 2;

CornerPlan with_strategy(const LegPath& path, const PlanOptions& options, CornerStrategy strategy) {
  PlanOptions one = options;
  one.strategy = strategy;
  std::set<std::size_t> alone;
  for (int attempt = 0;; ++attempt) {
    CornerPlan plan;
    plan.stages = stages_of(path, alone, one);
    const std::size_t known = alone.size();
    plan.speeds = corner_speeds(plan.stages);
    for (const Stage& stage : plan.stages) {
      if (stage.stretch && stage.stretch->failed()) alone.insert(stage.first_leg);
    }
    if (alone.size() == known) return plan;
    // Stretches that hold each other up: then none of them.
    for (std::size_t i = 0; attempt == kAttempts && i < path.legs.size(); ++i) alone.insert(i);
  }
}

// Without dwells, s.
double travel_time(const CornerPlan& plan) {
  double time = 0;
  CornerMotion entry;
  for (std::size_t i = 0; i < plan.stages.size(); ++i) {
    const Stage& stage = plan.stages[i];
    const CornerMotion exit = stage.exit.at(plan.speeds[i]);
    time += stage.stretch ? stage.stretch->spline().duration() : leg_time(stage.leg, entry, exit);
    time += exit.duration;
    entry = exit;
  }
  return time;
}

}  // namespace

CornerPlan plan_corners(const LegPath& path, const PlanOptions& options) {
  CornerPlan best = with_strategy(path, options, options.strategy);
  if (options.strategy != CornerStrategy::kAuto || path.legs.size() > kCompared) return best;
  double best_time = travel_time(best);
  for (const auto strategy : {CornerStrategy::kBlended, CornerStrategy::kInterrupted, CornerStrategy::kUninterrupted,
                              CornerStrategy::kExactStop}) {
    CornerPlan other = with_strategy(path, options, strategy);
    const double time = travel_time(other);
    if (time < best_time) {
      best = std::move(other);
      best_time = time;
    }
  }
  return best;
}

}  // namespace kcs::planning
