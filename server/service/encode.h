// From the planner's types to the messages of the contract.
#pragma once

#include <kcs/v1/planning.pb.h>

#include "server/jobs/plan_request.h"

namespace kcs::service {

void encode_plan(const jobs::KeptPlan& kept, v1::Plan& message);

// `options`: of the plan that the corner belongs to; they say what its deviation means.
void encode_corner(const planning::Corner& corner, const planning::PlanOptions& options, v1::Corner& message);

}  // namespace kcs::service
