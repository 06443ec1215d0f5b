// The options of a request: from the contract's message to the planner's types, with every number checked.
#pragma once

#include <kcs/v1/planning.pb.h>

#include "server/jobs/fair_queue.h"
#include "server/jobs/plan_request.h"
#include "server/service/violations.h"

namespace kcs::service {

// Throws planning::InvalidInput with all that is wrong; fills in the defaults of the contract.
jobs::RequestOptions decode_options(const v1::PlanOptions& options);

// The axes and their limits, of a machine in `field`; adds what is wrong.
planning::AxisLimits decode_limits(const v1::Machine& machine, const std::string& field, Violations& violations);

// Throws planning::InvalidInput for a number that the contract does not know.
jobs::Priority decode_priority(v1::Priority priority);

}  // namespace kcs::service
