#include "server/observe/server_metrics.h"

#include "server/version/version.h"

namespace kcs::observe {

ServerMetrics::ServerMetrics(Registry& registry)
    : planning_duration(registry.histogram(
          {"kcs_planning_duration_seconds", "Time that making a plan took, from its turn to its verification."})),
      segments_planned(registry.counter(
          {"kcs_segments_planned_total", "Segments of the paths that were planned, live ones included."})),
      rpcs_running(registry.gauges({"kcs_rpcs_running", "Calls that run now, streams among them.", {"method"}})),
      rpcs(registry.counters({"kcs_rpcs_total", "Calls that ended, by their status.", {"method", "code"}})),
      rpc_duration(registry.histograms(
          {"kcs_rpc_duration_seconds", "Time that calls took, from their start to their status.", {"method"}})),
      setpoints_sent(registry.counter({"kcs_setpoints_sent_total", "Setpoints that were sent, live ones included."})),
      rejections(registry.counters({"kcs_rejections_total",
                                    "Calls that were refused, by the cap that was reached, or else by their status.",
                                    {"reason"}})),
      store_duration(registry.histograms(
          {"kcs_store_duration_seconds", "Time that the store took, failures included.", {"operation"}})) {
  registry.gauges({"kcs_build_info", "Always 1; its labels say which server this is.", {"version", "build"}})
      .with({std::string(version()), std::string(build())})
      .add(1);
}

}  // namespace kcs::observe
