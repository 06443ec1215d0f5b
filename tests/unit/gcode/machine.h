// A machine at the start of a program, for the tests of what a line of it may ask and set.
#pragma once

#include <cstddef>
#include <string_view>

#include "server/gcode/expression.h"
#include "server/gcode/interpreter.h"
#include "server/gcode/notices.h"
#include "server/gcode/options.h"
#include "server/gcode/parameters.h"
#include "server/gcode/words.h"
#include "server/planning/toolpath.h"

namespace kcs::gcode {

class Machine {
 public:
  explicit Machine(std::size_t max_names = 100) : parameters_(interpreter_, max_names) {}

  // Reads and executes one line.
  void run(std::string_view line) {
    words_.read(line, ++line_, parameters_);
    for (const Setting& setting : words_.settings()) parameters_.set(setting);
    interpreter_.execute(words_);
  }

  // Takes a line apart without executing it.
  Words words_of(std::string_view text, std::uint32_t line) const {
    Words words;
    words.read(text, line, parameters_);
    return words;
  }

  // What a word in the next line would get for `text`.
  double value_of(std::string_view text) const {
    Cursor cursor(text, line_ + 1);
    return Expression(cursor, parameters_).value().value();
  }

 private:
  Notices notices_;
  Interpreter interpreter_{{}, [](const planning::Segment&) {}, notices_};
  Parameters parameters_;
  Words words_;
  std::uint32_t line_ = 0;
};

}  // namespace kcs::gcode
