#include "server/planning/planner.h"

#include "server/planning/live_planner.h"
#include "server/planning/validation.h"

namespace kcs::planning {
namespace {

class Keeper : public PlanReceiver {
 public:
  explicit Keeper(Plan& plan) : plan_(plan) {}
  void take(const motion::Phase& phase) override { plan_.trajectory.append(phase); }
  void take(const Corner& corner) override { plan_.corners.append(corner); }

 private:
  Plan& plan_;
};

}  // namespace

Plan plan(const Toolpath& path, const PlanOptions& options) {
  validate(path, options);
  Plan plan{.start = path.start};
  Keeper keeper(plan);
  LivePlanner planner(path, options, keeper);
  for (const Segment& segment : path.segments) planner.add(segment);
  plan.summary = planner.finish();
  plan.trajectory.set_final_state(planner.end_state());
  return plan;
}

}  // namespace kcs::planning
