// The operators of RS-274's expressions, as LinuxCNC extends them.
#pragma once

#include <span>
#include <string_view>

#include "server/gcode/place.h"

namespace kcs::gcode {

// Numbers that differ by less are equal to EQ and NE, and whole where a whole number is needed.
inline constexpr double kEqual = 1e-4;

struct Operator {
  std::string_view symbol;
  // Operators of a higher one come first; of equal ones the left comes first, ** too: [2**3**2] is 64.
  int precedence;
  // Comparisons and logic give 1 for true and 0 for false; all but 0 counts as true. Refuses, naming `place`, operands
  // for which there is no result. What it returns may be infinite.
  double (*result_of)(double left, double right, Place place);
};

inline constexpr int kLowestPrecedence = 1;

// A symbol that begins with another comes before it.
std::span<const Operator> operators();

}  // namespace kcs::gcode
