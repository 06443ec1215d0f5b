// Programs by chance, of everything that moves the tool or shifts its coordinates.
#pragma once

#include <cstdint>
#include <string>

namespace kcs::test {

// The same program for the same seed.
std::string random_program(std::uint32_t seed);

}  // namespace kcs::test
