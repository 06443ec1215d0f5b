#include "server/service/observation.h"

#include "server/observe/process_metrics.h"

namespace kcs::service {

void add_readings(observe::Registry& registry, const jobs::PlanDesk& desk) {
  registry.read_gauge({"kcs_planning_queue_depth", "Requests that wait to be planned."},
                      [&desk] { return static_cast<double>(desk.load().waiting); });
  registry.read_gauge({"kcs_plans_running", "Plans that are being made; not live ones, which are calls."},
                      [&desk] { return static_cast<double>(desk.load().running); });
  observe::add_process_metrics(registry);
}

void report(const Observation& observation, const jobs::PlanDesk::Planned& planned) {
  const planning::Summary& summary = planned.plan.plan.summary;
  observation.metrics.planning_duration.observe(planned.taken);
  observation.metrics.segments_planned.add(summary.segments);
  observation.log.write(spdlog::level::info, "planned",
                        {{"request_id", planned.call},
                         {"plan", planned.plan.name},
                         {"segments", summary.segments},
                         {"duration_s", planned.taken.count()},
                         {"cycle_time_s", summary.cycle_time}});
}

}  // namespace kcs::service
