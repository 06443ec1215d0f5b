// Requests for plans that a server makes and keeps while nobody waits for them.
#pragma once

#include <vector>

#include "tests/service/test_server.h"

namespace kcs::service::test {

// Options that ask only to be accepted.
v1::CreatePlanRequest accept_only(v1::PlanOptions options);

// A request that is accepted, as points and options can be seen to be right, but refused when it is planned: the tool
// cannot get so fast on so short a path.
v1::PlanOptions too_fast_at_the_end();

// A path that takes a second or so to plan.
v1::PathChunk long_path();
// A path of so many moves that nobody waits for its plan, in messages. With blended() options.
std::vector<v1::CreatePlanRequest> endless_path();
v1::PlanOptions blended();

std::vector<v1::CreatePlanRequest> join(v1::CreatePlanRequest first, std::vector<v1::CreatePlanRequest> rest);

}  // namespace kcs::service::test
