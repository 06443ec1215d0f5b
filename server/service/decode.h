// The options of a request: from the contract's message to the planner's types, with every number checked.
#pragma once

#include <kcs/v1/planning.pb.h>

#include "server/jobs/fair_queue.h"
#include "server/jobs/plan_request.h"

namespace kcs::service {

// Throws planning::InvalidInput with all that is wrong; fills in the defaults of the contract.
jobs::RequestOptions decode_options(const v1::PlanOptions& options);

// Throws planning::InvalidInput for a number that the contract does not know.
jobs::Priority decode_priority(v1::Priority priority);

}  // namespace kcs::service
