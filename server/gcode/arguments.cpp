#include "server/gcode/arguments.h"

#include <string>

#include "server/gcode/expression.h"
#include "server/gcode/parameter.h"

namespace kcs::gcode {
namespace {

std::optional<double> accept_argument(Cursor& cursor, const Parameters& parameters) {
  cursor.skip_comments();
  return cursor.at('[') ? Expression(cursor, parameters).value() : std::nullopt;
}

void expect_end(const OWord& word, Cursor& cursor, const char* what_it_takes) {
  cursor.skip_comments();
  if (cursor.at_end()) return;
  cursor.refuse_control_character();
  refuse(cursor.place(), "this does not belong to " + word.text() + ", which takes " + what_it_takes +
                             ". Put everything else on a line of its own.");
}

}  // namespace

double argument_of(const OWord& word, Cursor& cursor, const Parameters& parameters) {
  const std::optional<double> value = accept_argument(cursor, parameters);
  if (!value) refuse(cursor.place(), word.text() + " needs a value in brackets here, such as [#1 LT 5].");
  expect_end(word, cursor, "one value in brackets");
  return *value;
}

std::optional<double> optional_argument_of(const OWord& word, Cursor& cursor, const Parameters& parameters) {
  const std::optional<double> value = accept_argument(cursor, parameters);
  expect_end(word, cursor, "at most one value, in brackets");
  return value;
}

std::vector<double> arguments_of(const OWord& word, Cursor& cursor, const Parameters& parameters) {
  std::vector<double> values;
  while (const std::optional<double> value = accept_argument(cursor, parameters)) {
    if (values.size() == kLocalParameters) {
      refuse(word.place, word.text() + " has more than " + std::to_string(kLocalParameters) +
                             " values. Hand the others over in parameters from #31 on.");
    }
    values.push_back(*value);
  }
  expect_end(word, cursor, "values in brackets");
  return values;
}

void expect_no_argument(const OWord& word, Cursor& cursor) { expect_end(word, cursor, "no value"); }

}  // namespace kcs::gcode
