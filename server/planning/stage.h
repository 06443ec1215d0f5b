// The path as the tool travels it: straight legs, and stretches of short ones in one smooth motion.
#pragma once

#include <cstddef>
#include <memory>
#include <set>
#include <vector>

#include "server/planning/cornering.h"
#include "server/planning/entry.h"
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

// What a corner needs of the ways before and after it, so that the tool may be at the feed beyond, mm; as far as they
// reach, with those of the corners around it.
struct CornerNeeds {
  double before = 0, after = 0;
  bool smooth = false;  // it is no stop
  bool free = false;    // the tool passes at the feed, even if a bend begins or ends here
};

struct Stages {
  std::vector<Stage> stages;       // in the order of the path
  std::vector<CornerNeeds> needs;  // of each joint but the last
};

// end_speed: at the end of the path, at most, mm/s. Legs in `alone` begin no stretch; those with which none was found
// are added to it. A stretch that has begun already goes on; if no way is found, it has failed.
Stages stages_of(const LegPath& path, const Entry& entry, double end_speed, std::set<std::size_t>& alone,
                 const PlanOptions& options);

}  // namespace kcs::planning
