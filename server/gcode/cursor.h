// A place in the text of a line, and what is read there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "server/gcode/place.h"

namespace kcs::gcode {

// The longest name of a parameter or an O word, in bytes.
inline constexpr std::size_t kMaxNameLength = 100;

// Where it says that something is accepted or read, the cursor goes behind it. RS-274 allows blanks anywhere, even
// inside numbers and names; upper and lower case mean the same.
class Cursor {
 public:
  Cursor(std::string_view text, std::uint32_t line) : text_(text), line_(line) {}

  bool at_end() const { return next_ == text_.size(); }
  // Not at the end.
  char peek() const { return text_[next_]; }
  void skip() { ++next_; }
  // At a letter: takes it, in upper case.
  char take_letter() { return upper(text_[next_++]); }
  Place place() const { return {line_, static_cast<std::uint32_t>(next_ + 1)}; }

  bool at(char c) const { return !at_end() && peek() == c; }
  bool at_blank() const { return at(' ') || at('\t'); }
  bool at_digit() const { return !at_end() && peek() >= '0' && peek() <= '9'; }
  bool at_letter() const { return !at_end() && is_letter(peek()); }
  void skip_blanks() {
    while (at_blank()) ++next_;
  }

  // Whether a number begins here: digits, or a sign that belongs to nothing else.
  bool at_number() const { return !at_end() && (is_digit_or_point(peek()) || (is_sign(peek()) && !at_signed_value())); }
  // Reads a number. Refuses what is none, and what seems to have an exponent.
  double number();

  // Goes behind `symbol`, in upper case, if that is what comes next.
  bool accept(std::string_view symbol);

  // Reads the name of a parameter or an O word, in lower case, up to its '>'.
  std::string name();

  // Leaves out a comment that ends with the line.
  void skip_rest();
  // Leaves out a comment in parentheses.
  void skip_parentheses();
  // Leaves out blanks and comments of both kinds.
  void skip_comments();

  // Refuses that something other than a word, a blank or a comment comes next.
  [[noreturn]] void refuse_character() const;
  void refuse_control_character() const;

 private:
  static bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }
  static char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }
  static bool is_sign(char c) { return c == '-' || c == '+'; }
  static bool is_digit_or_point(char c) { return (c >= '0' && c <= '9') || c == '.'; }

  bool at_signed_value() const;
  bool is_at_exponent() const;

  std::string_view text_;
  std::size_t next_ = 0;
  std::uint32_t line_;
};

}  // namespace kcs::gcode
