#include "server/planning/corner_plan.h"

#include <cstddef>
#include <set>
#include <utility>

#include "server/planning/leg_profile.h"
#include "server/planning/lookahead.h"
#include "server/planning/stopped.h"

namespace kcs::planning {
namespace {

// A stretch that cannot be as slow at its ends as its neighbours ask is taken apart, and all is planned again, so
// often.
constexpr int kAttempts = 2;

// Without dwells, s.
double travel_time(const CornerPlan& plan, const Entry& begin, const std::stop_token& stop) {
  double time = 0;
  CornerMotion entry = begin.motion;
  for (std::size_t i = 0; i < plan.stages.size(); ++i) {
    throw_if_stopped(stop);
    const Stage& stage = plan.stages[i];
    const CornerMotion exit = stage.exit.at(plan.speeds[i]);
    time += stage.stretch ? stage.stretch->duration() : leg_time(stage.leg, entry, exit);
    time += exit.duration;
    entry = exit;
  }
  return time;
}

}  // namespace

std::optional<CornerPlan> plan_corners(const LegPath& path, const Entry& entry, double end_speed,
                                       const PlanOptions& options) {
  std::set<std::size_t> alone;
  for (int attempt = 0;; ++attempt) {
    auto [stages, needs] = stages_of(path, entry, end_speed, alone, options);
    const std::size_t known = alone.size();
    if (entry.begun && stages.front().stretch->failed()) return {};
    auto speeds = corner_speeds(stages, entry.motion, options.stop);
    if (!speeds || (entry.begun && stages.front().stretch->failed())) return {};
    for (const Stage& stage : stages) {
      if (stage.stretch && stage.stretch->failed()) alone.insert(stage.first_leg);
    }
    if (alone.size() == known) return CornerPlan{std::move(stages), std::move(needs), std::move(*speeds), known > 0};
    // Stretches that hold each other up: then none of them.
    for (std::size_t i = 0; attempt == kAttempts && i < path.legs.size(); ++i) alone.insert(i);
  }
}

std::optional<CornerPlan> compare_corners(const LegPath& path, const Entry& entry, double end_speed,
                                          const PlanOptions& options) {
  const auto planned = [&](const PlanOptions& with) {
    auto plan = plan_corners(path, entry, end_speed, with);
    if (!plan) return plan;
    for (const Stage& stage : plan->stages) {
      if (stage.stretch) stage.stretch->tighten(stage.stretch->pieces().size());
    }
    return plan;
  };
  const auto is_better = [&](const CornerPlan& plan, const CornerPlan& than) {
    const bool reaches = plan.speeds.back() >= end_speed;
    if (reaches != (than.speeds.back() >= end_speed)) return reaches;
    return travel_time(plan, entry, options.stop) < travel_time(than, entry, options.stop);
  };
  auto best = planned(options);
  if (options.strategy != CornerStrategy::kAuto) return best;
  for (const auto strategy : {CornerStrategy::kBlended, CornerStrategy::kInterrupted, CornerStrategy::kUninterrupted,
                              CornerStrategy::kExactStop}) {
    PlanOptions one = options;
    one.strategy = strategy;
    auto other = planned(one);
    if (!other || (best && !is_better(*other, *best))) continue;
    other->taken_apart = best && best->taken_apart;
    best = std::move(other);
  }
  return best;
}

}  // namespace kcs::planning
