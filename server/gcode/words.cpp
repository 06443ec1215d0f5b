#include "server/gcode/words.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <string>

namespace kcs::gcode {
namespace {

constexpr std::size_t kMaxNumberLength = 64;  // characters; no machine resolves a tenth of them
constexpr double kMaxCode = 9999;             // of G and M words

bool is_blank(char c) { return c == ' ' || c == '\t'; }
bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 && c != '\t'; }
bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }
bool is_part_of_number(char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+'; }
char upper(char c) { return c >= 'a' ? static_cast<char>(c - 'a' + 'A') : c; }

// A place in the text of a line.
class Cursor {
 public:
  Cursor(std::string_view text, std::uint32_t line) : text_(text), line_(line) {}

  bool at_end() const { return next_ == text_.size(); }
  char peek() const { return text_[next_]; }
  char take() { return text_[next_++]; }
  Place place() const { return {line_, static_cast<std::uint32_t>(next_ + 1)}; }

  void skip_blanks() {
    while (!at_end() && is_blank(peek())) ++next_;
  }

  // Leaves out a comment that ends with the line.
  void skip_rest() {
    for (; !at_end(); ++next_) refuse_control_character();
  }

  // Leaves out a comment in parentheses.
  void skip_parentheses() {
    const Place start = place();
    for (++next_; !at_end(); ++next_) {
      refuse_control_character();
      if (peek() == '(') refuse(place(), "a comment opens inside a comment. Close the first one, or use ; for both.");
      if (peek() == ')') {
        ++next_;
        return;
      }
    }
    refuse(start, "the comment is not closed on its line. Add ')', or begin it with ; instead.");
  }

  // Reads the number of the word `letter`.
  double number(char letter) {
    std::array<char, kMaxNumberLength> digits;
    std::size_t length = 0;
    skip_blanks();
    const Place start = place();
    for (; !at_end() && (is_part_of_number(peek()) || is_blank(peek())); ++next_) {
      if (is_blank(peek())) continue;
      if (length == digits.size()) refuse(start, "the number has too many digits. Write at most 64 characters.");
      digits[length++] = peek();
    }
    if (length == 0) refuse_number(letter);
    if (is_at_exponent()) {
      refuse(start,
             "an E right after a number could begin an exponent or a word. Write the number without exponent, such as "
             "0.000099, or put a blank before the E word.");
    }
    // from_chars knows no plus sign.
    const char* first = digits.data() + (digits[0] == '+' && length > 1 && digits[1] != '-' ? 1 : 0);
    const char* last = digits.data() + length;
    double value = 0;
    const auto [end, error] = std::from_chars(first, last, value, std::chars_format::fixed);
    if (error != std::errc() || end != last) {
      refuse(start,
             "'" + std::string(digits.data(), length) + "' is not a number. Write it like -12.5, without exponent.");
    }
    return value;
  }

  void refuse_control_character() const {
    if (!at_end() && is_control(peek())) {
      refuse(place(), "control character " + std::to_string(peek()) +
                          ". G-code is plain text: save the program as ASCII or UTF-8.");
    }
  }

  // Something other than a word, a blank or a comment.
  [[noreturn]] void refuse_character() const {
    refuse_control_character();
    switch (peek()) {
      case '#':
        refuse(place(), "parameters (#) are not supported. Let the CAM program write out the numbers.");
      case '[':
        refuse(place(), "expressions ([...]) are not supported. Let the CAM program write out the numbers.");
      case '/':
        refuse(place(), "'/' skips a block only as the first character of its line.");
      case '%':
        refuse(place(), "'%' must stand alone on its line.");
      case ')':
        refuse(place(), "')' without '('. Comments are ( ) on one line, or ; to the end of the line.");
      default:
        break;
    }
    if (is_part_of_number(peek())) refuse(place(), "a number without a letter. Write a word such as X1.5.");
    const unsigned byte = static_cast<unsigned char>(peek());
    const std::string name =
        byte > 0x20 && byte < 0x7f ? std::string("'") + peek() + "'" : "byte " + std::to_string(byte);
    refuse(place(), name + " means nothing outside a comment. Remove it.");
  }

 private:
  // Right after a number: whether it goes on with E and a whole number, which other languages take for an exponent
  // (9.9e-05). With a decimal point that is no exponent but a printer's E word (X10E1.5).
  bool is_at_exponent() const {
    if (at_end() || upper(peek()) != 'E' || !is_part_of_number(text_[next_ - 1])) return false;
    const bool has_sign = next_ + 1 < text_.size() && (text_[next_ + 1] == '+' || text_[next_ + 1] == '-');
    const std::size_t first = next_ + (has_sign ? 2 : 1);
    const std::size_t after = std::min(text_.find_first_not_of("0123456789", first), text_.size());
    return after > first && (after == text_.size() || text_[after] != '.');
  }

  [[noreturn]] void refuse_number(char letter) const {
    if (!at_end() && !is_letter(peek())) refuse_character();
    refuse(place(), std::string(1, letter) + " has no number. Write one after it, or put the text into a comment.");
  }

  std::string_view text_;
  std::size_t next_ = 0;
  std::uint32_t line_;
};

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

void Words::read(std::string_view text, std::uint32_t line) {
  line_ = line;
  start_column_ = 0;
  present_ = 0;
  codes_.clear();
  Cursor cursor(text, line);
  while (!cursor.at_end()) {
    const char next = cursor.peek();
    if (is_letter(next)) {
      const Place place = cursor.place();
      const char letter = upper(cursor.take());
      if (letter == 'O') {
        refuse(place,
               "O words (program numbers, subroutines, loops) are not supported. Let the CAM program write out "
               "every move, and put a program number into a comment.");
      }
      add(letter, cursor.number(letter), place);
    } else if (is_blank(next)) {
      cursor.take();
    } else if (next == ';') {
      cursor.skip_rest();
    } else if (next == '(') {
      cursor.skip_parentheses();
    } else {
      cursor.refuse_character();
    }
  }
  start_column_ = std::max(start_column_, 1U);
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
