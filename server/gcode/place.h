// Where something stands in a program, and the refusal that names it.
#pragma once

#include <cstdint>
#include <string>

namespace kcs::gcode {

struct Place {
  std::uint32_t line = 0;    // from 1
  std::uint32_t column = 0;  // from 1, in bytes
};

// "gcode, line L, column C": how a violation names its place.
std::string field_of(Place place);

// Throws planning::InvalidInput with one violation, whose field is field_of(place).
// reason: what is wrong and what to do about it, in plain sentences.
[[noreturn]] void refuse(Place place, const std::string& reason);

}  // namespace kcs::gcode
