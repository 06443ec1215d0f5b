// Seeded random planning problems of many short segments: what a curve becomes on its way through CAM software.
#pragma once

#include "tests/property/random_case.h"

namespace kcs::test {

// The same seed gives the same case: 20 to 300 segments along an arc, a spiral, a free curve, a wavy relief, a
// staircase or an outline of lines and fillets, of 0.01 to 1 mm each, or of lengths mixed over six decades, or of no
// more than 1 µm; points up to 1 µm off their place; feeds and tolerances that may change on the way, stops, dwells,
// long lines before and after; limits like those of real machines or any at all. To be taken by whatever is fastest.
Case dense_case(std::uint64_t seed);

}  // namespace kcs::test
