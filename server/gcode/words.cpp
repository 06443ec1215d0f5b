#include "server/gcode/words.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "server/gcode/cursor.h"
#include "server/gcode/expression.h"

namespace kcs::gcode {
namespace {

constexpr double kMaxCode = 9999;  // of G and M words

int tenths_of(char letter, double value, Place place) {
  const double tenths = std::round(value * 10);
  const bool fits = value >= 0 && value <= kMaxCode && std::abs(value * 10 - tenths) < 1e-6;
  if (!fits || (letter == 'M' && std::fmod(tenths, 10) != 0)) {
    refuse(place,
           std::string("no such ") + letter + " word: G takes 0 to 9999 with at most one decimal, M whole numbers.");
  }
  return static_cast<int>(tenths);
}

}  // namespace

void Words::read(std::string_view text, std::uint32_t line, const Parameters& parameters) {
  line_ = line;
  start_column_ = 0;
  present_ = 0;
  codes_.clear();
  settings_.clear();
  Cursor cursor(text, line);
  while (!cursor.at_end()) {
    if (cursor.at_letter() || cursor.at('@') || cursor.at('^')) {
      read_word(cursor, parameters);
    } else if (cursor.at_blank()) {
      cursor.skip();
    } else if (cursor.at('#')) {
      read_setting(cursor, parameters);
    } else if (cursor.at(';')) {
      cursor.skip_rest();
    } else if (cursor.at('(')) {
      cursor.skip_parentheses();
    } else {
      cursor.refuse_character();
    }
  }
  start_column_ = std::max(start_column_, 1U);
}

void Words::read_word(Cursor& cursor, const Parameters& parameters) {
  const Place place = cursor.place();
  const char letter = cursor.take_letter();
  if (letter == 'O') {
    refuse(place,
           "an O word stands first on its line, behind nothing but a line number (N). Begin a new line with it.");
  }
  cursor.skip_blanks();
  if (cursor.at_number()) {
    add(letter, cursor.number(), place);
  } else if (const auto value = Expression(cursor, parameters).value()) {
    add(letter, *value, place);
  } else {
    if (!cursor.at_end() && !cursor.at_letter()) cursor.refuse_character();
    refuse(cursor.place(),
           std::string(1, letter) + " has no number. Write one after it, or put the text into a comment.");
  }
}

void Words::read_setting(Cursor& cursor, const Parameters& parameters) {
  const Place place = cursor.place();
  Expression expression(cursor, parameters);
  Parameter parameter = expression.parameter();
  if (!cursor.accept("=")) {
    refuse(place, parameter.text() + " stands alone. Set it (" + parameter.text() + "=2.5), or give it to a letter (X" +
                      parameter.text() + ").");
  }
  const std::optional<double> value = expression.value();
  if (!value) refuse(cursor.place(), parameter.text() + " is set to nothing. Write a value after '='.");
  settings_.push_back({std::move(parameter), *value, place});
}

void Words::add(char letter, double value, Place place) {
  if (start_column_ == 0 && letter != 'N') start_column_ = place.column;
  if (letter == 'G' || letter == 'M') {
    codes_.push_back({letter, tenths_of(letter, value, place), place});
    return;
  }
  if (has(letter)) {
    refuse(place, std::string(1, letter) + " comes twice in this block. Keep one, or make two blocks of it.");
  }
  present_ |= Letters{1} << index(letter);
  values_[index(letter)] = value;
  columns_[index(letter)] = place.column;
}

Place Words::first_of(Letters set) const {
  Place first{line_, UINT32_MAX};
  for (Letters rest = present_ & set; rest != 0; rest &= rest - 1) {
    first.column = std::min(first.column, columns_[static_cast<std::size_t>(std::countr_zero(rest))]);
  }
  return first;
}

}  // namespace kcs::gcode
