// Seeded random planning problems of many kinds of motion one after the other: longer than what is planned at a time.
#pragma once

#include <cstdint>

#include "tests/property/random_case.h"

namespace kcs::test {

// The same seed gives the same case: the options of a dense case, and the paths of up to four dense and random cases,
// each beginning where the one before it ends: 40 to 1,500 segments.
Case long_case(std::uint64_t seed);

}  // namespace kcs::test
