#include "server/gcode/expression.h"

#include <cmath>
#include <string>

#include "server/gcode/functions.h"
#include "server/gcode/trigonometry.h"

namespace kcs::gcode {
namespace {

double finite(double result, Place place) {
  if (!std::isfinite(result)) refuse(place, "the result is too large for a number. Check the values that go into it.");
  return result;
}

// Refuses what stands where `missing` is needed.
[[noreturn]] void refuse_instead_of(const std::string& missing, const Cursor& cursor) {
  cursor.refuse_control_character();
  if (!cursor.at_end() && cursor.peek() == '(') {
    refuse(cursor.place(), "parentheses make comments, which cannot stand inside an expression. Group with [ ].");
  }
  refuse(cursor.place(), missing);
}

}  // namespace

std::optional<double> Expression::value() {
  if (++depth_ > kMaxDepth) {
    refuse(cursor_.place(), "values stand more than " + std::to_string(kMaxDepth) +
                                " deep inside one another. Compute parts of them on lines before, into parameters.");
  }
  cursor_.skip_blanks();
  const Place place = cursor_.place();
  std::optional<double> result;
  if (cursor_.at_number()) {
    result = cursor_.number();
  } else if (cursor_.at('#')) {
    result = parameters_.value(parameter(), place);
  } else if (cursor_.at('[')) {
    result = bracketed("");
  } else if (cursor_.accept("-")) {
    result = -required_value();
  } else if (cursor_.accept("+")) {
    result = required_value();
  } else {
    result = function();
  }
  --depth_;
  return result;
}

Parameter Expression::parameter() {
  cursor_.skip();
  if (cursor_.accept("<")) return {.name = cursor_.name()};
  const Place place = cursor_.place();
  const std::optional<double> number = value();
  if (!number) {
    refuse_instead_of("'#' begins a parameter: its number (#5) or its name (#<depth>) is missing here.", cursor_);
  }
  const double whole = std::round(*number);
  if (std::abs(*number - whole) > kEqual || whole < 1 || whole > kMaxParameter) {
    refuse(place, "there is no parameter number " + std::to_string(*number) +
                      ". Parameters have whole numbers from 1 to " + std::to_string(kMaxParameter) + ".");
  }
  return {.number = static_cast<int>(whole)};
}

double Expression::required_value() {
  if (const auto result = value()) return *result;
  refuse_instead_of(
      "a value is missing here: a number, a parameter (#5, #<depth>), a function (SIN[30]) or an expression in [ ].",
      cursor_);
}

// Values with operators of at least that precedence between them.
double Expression::operation(int lowest_precedence) {
  double result = required_value();
  for (;;) {
    cursor_.skip_blanks();
    const Place place = cursor_.place();
    const Operator* next = accept_operator(lowest_precedence);
    if (next == nullptr) return result;
    result = finite(next->result_of(result, operation(next->precedence + 1), place), place);
  }
}

const Operator* Expression::accept_operator(int lowest_precedence) {
  const Cursor before = cursor_;
  for (const Operator& candidate : operators()) {
    if (!cursor_.accept(candidate.symbol)) continue;
    if (candidate.precedence >= lowest_precedence) return &candidate;
    cursor_ = before;
    break;
  }
  return nullptr;
}

// An expression in brackets, which `name` needs; no name for one of its own.
double Expression::bracketed(std::string_view name) {
  cursor_.skip_blanks();
  const Place start = cursor_.place();
  if (!cursor_.accept("[")) refuse_instead_of(std::string(name) + " needs a value in brackets here: [30].", cursor_);
  const double result = operation(kLowestPrecedence);
  if (cursor_.accept("]")) return result;
  if (cursor_.at_end()) refuse(start, "the expression is not closed on its line. Add ']'.");
  refuse_instead_of(
      "an operator or ']' is missing here. The operators are + - * / ** MOD, EQ NE GT GE LT LE, AND OR and XOR.",
      cursor_);
}

std::optional<double> Expression::function() {
  if (!cursor_.at_letter()) return std::nullopt;
  const Place place = cursor_.place();
  if (cursor_.accept("ATAN")) return arc_tangent_of_two();
  if (cursor_.accept("EXISTS")) return exists();
  for (const Function& candidate : functions()) {
    if (!cursor_.accept(candidate.name)) continue;
    return finite(candidate.value_of(bracketed(candidate.name), place), place);
  }
  return std::nullopt;
}

double Expression::arc_tangent_of_two() {
  const double y = bracketed("ATAN");
  if (!cursor_.accept("/")) refuse_instead_of("ATAN takes two values: ATAN[1]/[2]. '/' is missing here.", cursor_);
  const double x = bracketed("ATAN");
  return degrees_of(arc_tangent(y, x));
}

double Expression::exists() {
  const Place place = cursor_.place();
  if (cursor_.accept("[")) {
    cursor_.skip_blanks();
    if (cursor_.at('#')) {
      const bool result = parameters_.exists(parameter(), place);
      if (cursor_.accept("]")) return result ? 1 : 0;
    }
  }
  refuse(place, "EXISTS asks for one parameter: EXISTS[#<depth>].");
}

}  // namespace kcs::gcode
