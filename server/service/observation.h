// What a server says of itself while it works.
#pragma once

#include "server/jobs/plan_desk.h"
#include "server/observe/log.h"
#include "server/observe/readiness.h"
#include "server/observe/registry.h"
#include "server/observe/server_metrics.h"

namespace kcs::service {

struct Observation {
  observe::Log log;
  observe::Registry registry = {};
  observe::ServerMetrics metrics{registry};
  observe::Readiness readiness = {};
};

// Adds the figures that are read when they are asked for: those of the process, and how much waits at the desk, which
// must be there as long as figures are shown.
void add_readings(observe::Registry& registry, const jobs::PlanDesk& desk);

// Counts and logs a plan that was made.
void report(const Observation& observation, const jobs::PlanDesk::Planned& planned);

}  // namespace kcs::service
