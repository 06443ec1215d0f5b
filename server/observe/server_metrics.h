// Every figure of kcsd, with what it says.
#pragma once

#include "server/observe/registry.h"

namespace kcs::observe {

// The metrics that are counted where things happen. What is read when it is asked for (queue, process) is added to the
// registry by whoever knows it. All are safe for use by many threads at once, and live as long as the registry.
struct ServerMetrics {
  // Adds them to `registry`, with kcs_build_info for this version.
  explicit ServerMetrics(Registry& registry);

  // Planning.
  Histogram& planning_duration;
  Counter& segments_planned;

  // Calls. Labels: method, such as "CreatePlan"; code, such as "INVALID_ARGUMENT".
  Family<Gauge>& rpcs_running;      // method
  Family<Counter>& rpcs;            // method, code
  Family<Histogram>& rpc_duration;  // method
  Counter& setpoints_sent;
  // Label: reason, the name of the cap that was reached, or else the code in lower case.
  Family<Counter>& rejections;

  // The store. Label: operation, such as "keep".
  Family<Histogram>& store_duration;
};

}  // namespace kcs::observe
