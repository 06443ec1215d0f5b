// The functions of RS-274 that take one argument: SIN[30]. Angles are in degrees.
#pragma once

#include <span>
#include <string_view>

#include "server/gcode/place.h"

namespace kcs::gcode {

struct Function {
  std::string_view name;
  // Refuses, naming `place`, an argument for which the function has no value. What it returns may be infinite.
  double (*value_of)(double argument, Place place);
};

// None of the names is the beginning of another.
std::span<const Function> functions();

}  // namespace kcs::gcode
