// The path as the tool travels it: straight legs, and stretches of short ones in one smooth motion.
#pragma once

#include <cstddef>
#include <memory>
#include <set>
#include <vector>

#include "server/planning/cornering.h"
#include "server/planning/leg.h"
#include "server/planning/stretch.h"

namespace kcs::planning {

// Between two corners: a leg, what a stretch leaves of a leg, or a stretch.
struct Stage {
  Leg leg;                           // if there is no stretch
  std::shared_ptr<Stretch> stretch;  // shared, for stages are copied
  Cornering exit;                    // how its end is taken; at the end of the path: rest
  std::size_t first_leg = 0;         // of the path
  std::size_t last_leg = 0;          // where it ends
  bool ends_on_joint = true;         // it ends where that leg does
};

// In the order of the path. Legs in `alone` begin no stretch; those with which none was found are added to it.
std::vector<Stage> stages_of(const LegPath& path, std::set<std::size_t>& alone, const PlanOptions& options);

}  // namespace kcs::planning
