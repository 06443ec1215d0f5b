// One line of a program, taken apart into words: a letter and a number each.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "server/gcode/parameter.h"
#include "server/gcode/place.h"

namespace kcs::gcode {

class Cursor;
class Parameters;

// A set of letters, one bit each.
using Letters = std::uint32_t;

// The bit of a letter. @ and ^, which state a radius and an angle, count as letters.
constexpr int bit_of(char letter) { return letter == '@' ? 26 : letter - 'A'; }
inline constexpr std::size_t kLetters = bit_of('^') + 1;

constexpr Letters letters(std::string_view list) {
  Letters set = 0;
  for (const char letter : list) set |= Letters{1} << bit_of(letter);
  return set;
}

// Axes that no machine of kcs has: rotary ones, and second linear ones.
inline constexpr Letters kMissingAxes = letters("ABCUVW");

// A G or M word.
struct Code {
  char letter = 'G';  // G or M
  int tenths = 0;     // its number times ten: G59.1 is 591
  Place place;
};

// The words of one line. Use the same object for line after line: it keeps its memory.
class Words {
 public:
  // Takes a line apart: comments and white space are left out (RS-274 allows blanks anywhere, even inside numbers),
  // upper and lower case mean the same. `parameters` are those from before the line: its own settings come into force
  // behind it. Refuses what is no word and no setting, control characters, a number that cannot be read or computed
  // or seems to have an exponent, O words (o_word.h), and a letter that comes twice (G and M may).
  void read(std::string_view text, std::uint32_t line, const Parameters& parameters);

  bool has(char letter) const { return has_any(Letters{1} << bit_of(letter)); }
  bool has_any(Letters set) const { return (present_ & set) != 0; }
  // The letters of the line other than G and M.
  Letters present() const { return present_; }

  // For letters that the line has, other than G and M.
  double value(char letter) const { return values_[index(letter)]; }
  Place place(char letter) const { return {line_, columns_[index(letter)]}; }
  // The first word on the line that is one of `set`, which the line must have.
  Place first_of(Letters set) const;

  // The G and M words in their order.
  const std::vector<Code>& codes() const { return codes_; }

  // What the line sets parameters to, in its order.
  const std::vector<Setting>& settings() const { return settings_; }

  // The first word that is not the line's number N; column 1 if there is none.
  Place start() const { return {line_, start_column_}; }

 private:
  static std::size_t index(char letter) { return static_cast<std::size_t>(bit_of(letter)); }
  void read_word(Cursor& cursor, const Parameters& parameters);
  void read_setting(Cursor& cursor, const Parameters& parameters);
  void add(char letter, double value, Place place);

  std::uint32_t line_ = 0;
  std::uint32_t start_column_ = 1;
  Letters present_ = 0;
  std::array<double, kLetters> values_{};
  std::array<std::uint32_t, kLetters> columns_{};
  std::vector<Code> codes_;
  std::vector<Setting> settings_;
};

}  // namespace kcs::gcode
