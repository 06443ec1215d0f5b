// Judges a plan by means of its own: plain sampling and plain geometry, not the verifier that the planner itself uses.
#pragma once

#include "server/planning/plan.h"
#include "tests/property/random_case.h"

namespace kcs::test {

// Fails the running test for every promise that `plan` does not keep.
void judge(const Case& problem, const planning::Plan& plan);

}  // namespace kcs::test
