// The values that stand behind an O word, in brackets: o100 call [2] [#1+1].
#pragma once

#include <optional>
#include <vector>

#include "server/gcode/cursor.h"
#include "server/gcode/o_word.h"
#include "server/gcode/parameters.h"

namespace kcs::gcode {

// All of them read up to the end of the line, comments included, and refuse what else stands there.

// The one value that `word` needs.
double argument_of(const OWord& word, Cursor& cursor, const Parameters& parameters);

// The value that `word` may have.
std::optional<double> optional_argument_of(const OWord& word, Cursor& cursor, const Parameters& parameters);

// As many as there are. Refuses more than kLocalParameters.
std::vector<double> arguments_of(const OWord& word, Cursor& cursor, const Parameters& parameters);

// For a word that takes none.
void expect_no_argument(const OWord& word, Cursor& cursor);

}  // namespace kcs::gcode
