// Numbers that a program computes: parameters, functions and expressions in brackets.
#pragma once

#include <optional>
#include <string_view>

#include "server/gcode/cursor.h"
#include "server/gcode/operators.h"
#include "server/gcode/parameter.h"
#include "server/gcode/parameters.h"

namespace kcs::gcode {

// How deep values may stand inside one another, which bounds the stack.
inline constexpr int kMaxDepth = 50;

// Reads and computes values as they stand in a line:
//   value       number, parameter, function, [ expression ], or one of the last three after a sign
//   parameter   # and a value (its number), or #< a name >
//   function    SIN[30] (functions.h), ATAN[1]/[2], EXISTS[#<name>]
//   expression  values with operators between them (operators.h)
// Refuses, naming the place, what has no result or no finite one.
class Expression {
 public:
  // Both must outlive the object. Reading goes on at the cursor.
  Expression(Cursor& cursor, const Parameters& parameters) : cursor_(cursor), parameters_(parameters) {}

  // The value at the cursor; nothing if there is none.
  std::optional<double> value();

  // The parameter at the cursor, which stands at its '#'.
  Parameter parameter();

 private:
  double required_value();
  double operation(int lowest_precedence);
  const Operator* accept_operator(int lowest_precedence);
  std::optional<double> function();
  double bracketed(std::string_view name);
  double arc_tangent_of_two();
  double exists();

  Cursor& cursor_;
  const Parameters& parameters_;
  int depth_ = 0;
};

}  // namespace kcs::gcode
