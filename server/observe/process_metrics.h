// What the operating system says of this process.
#pragma once

#include "server/observe/registry.h"

namespace kcs::observe {

// Adds the figures that every Prometheus client library has under the same names: process_start_time_seconds,
// process_cpu_seconds_total, process_resident_memory_bytes, process_open_fds, process_max_fds.
void add_process_metrics(Registry& registry);

}  // namespace kcs::observe
