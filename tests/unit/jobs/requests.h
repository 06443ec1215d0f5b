// Requests to be planned.
#pragma once

#include <string>

#include "server/jobs/plan_request.h"

namespace kcs::jobs::test {

// Two legs; planned in less than a millisecond.
PlanRequest right_angle(const std::string& name);
// Takes some tenths of a second.
PlanRequest large(const std::string& name);
// Takes many seconds, so many that nobody waits for it.
PlanRequest endless(const std::string& name);

}  // namespace kcs::jobs::test
