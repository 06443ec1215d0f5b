// Seeded random planning problems, from the mild to the absurd but valid.
#pragma once

#include <cstdint>
#include <string>

#include "server/planning/options.h"
#include "server/planning/toolpath.h"

namespace kcs::test {

struct Case {
  planning::Toolpath path;
  planning::PlanOptions options;
};

// The same seed gives the same case: two or three axes, up to 40 segments of 1 µm to 10 m, directions from straight on
// over nearly straight (down to 1e-9 rad) to reversal, limits that differ from axis to axis by up to a factor of 100,
// lines cut into equal pieces, returns to the same point from afar,
// feeds, tolerances, stops and dwells that change from segment to segment, repeated points, every strategy.
Case random_case(std::uint64_t seed);

// The case in full, for a failing test's message.
std::string describe(const Case& problem);

}  // namespace kcs::test
