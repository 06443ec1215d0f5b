// RS-274's variables, as a program names them.
#pragma once

#include <string>

#include "server/gcode/place.h"

namespace kcs::gcode {

// The highest number of a parameter.
inline constexpr int kMaxParameter = 5602;

// Those up to this number belong to the subroutine that is running, which begins with its arguments in them.
inline constexpr int kLocalParameters = 30;

// #5, or #<depth>.
struct Parameter {
  int number = 0;    // 0: it has a name
  std::string name;  // in lower case and without blanks, which make no difference in a program

  bool is_local() const { return number == 0 ? !name.starts_with('_') : number <= kLocalParameters; }

  // As one writes it in a program.
  std::string text() const { return number == 0 ? "#<" + name + ">" : "#" + std::to_string(number); }
};

// #5=2.5
struct Setting {
  Parameter parameter;
  double value = 0;
  Place place;
};

}  // namespace kcs::gcode
