#include "server/planning/plan_path.h"

#include "server/planning/planner.h"

namespace kcs::planning {

Plan plan(const Toolpath& path, const PlanOptions& options) {
  Planner planner(path, options);
  while (planner.go_on()) {
  }
  return planner.take_plan();
}

}  // namespace kcs::planning
