// Counts what a test program allocates, to show that something allocates nothing.
#pragma once

#include <cstddef>

namespace kcs::test {

// How often the calling thread has allocated memory so far.
std::size_t allocations();

}  // namespace kcs::test
