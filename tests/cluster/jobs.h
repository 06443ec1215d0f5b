// What clients of a cluster ask for.
#pragma once

#include <cstdint>

#include "client/sdk/planner.h"

namespace kcs::test {

// Segments of up to `longest` mm along each of two axes, with corners of all angles; another path for each seed.
client::PointPath corners(std::uint64_t seed, int segments, double longest);

client::PlanOptions job_options();

}  // namespace kcs::test
