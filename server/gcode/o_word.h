// The O words of RS-274, with which a program repeats, chooses and calls: o100 while [#1 LT 5].
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "server/gcode/cursor.h"
#include "server/gcode/place.h"

namespace kcs::gcode {

enum class Keyword : std::uint8_t {
  kSub,
  kEndSub,
  kCall,
  kReturn,
  kIf,
  kElseIf,
  kElse,
  kEndIf,
  kWhile,
  kEndWhile,
  kDo,
  kRepeat,
  kEndRepeat,
  kBreak,
  kContinue,
  kNone,  // a program number: O1234 alone on its line
};

struct OWord {
  std::string label;  // digits without leading zeros, or a name in lower case: O0100 and o<100> mean the same
  Keyword keyword = Keyword::kNone;
  Place place;

  // As one writes it in a program: "o100 while", "o<slot> sub".
  std::string text() const { return text(keyword); }
  // With another keyword.
  std::string text(Keyword other) const;
};

// "o100" or "o<slot>", for the label of an O word.
std::string name_of(const std::string& label);

// Whether the first word of a line, a line number (N) aside, is an O word.
bool begins_with_o_word(std::string_view line);

// Reads the O word with which a line begins, without what its keyword takes. Refuses one without a label or with an
// unknown keyword.
OWord read_o_word(Cursor& cursor);

}  // namespace kcs::gcode
