#include "server/gcode/cursor.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace kcs::gcode {
namespace {

constexpr std::size_t kMaxNumberLength = 64;  // characters; no machine resolves a tenth of them

bool is_blank(char c) { return c == ' ' || c == '\t'; }
bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 && c != '\t'; }
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

}  // namespace

// At a sign: whether it belongs to a parameter, an expression or a function.
bool Cursor::at_signed_value() const {
  Cursor rest = *this;
  rest.skip();
  rest.skip_blanks();
  return rest.at_letter() || rest.at('#') || rest.at('[');
}

double Cursor::number() {
  std::array<char, kMaxNumberLength> digits;
  std::size_t length = 0;
  const Place start = place();
  std::size_t next = next_;  // not the member itself: for all that the compiler knows, `digits` could overwrite that
  for (; next < text_.size(); ++next) {
    const char c = text_[next];
    if (is_blank(c)) continue;
    if (!is_digit_or_point(c) && !(is_sign(c) && length == 0)) break;
    if (length == digits.size()) refuse(start, "the number has too many digits. Write at most 64 characters.");
    digits[length++] = c;
  }
  next_ = next;
  if (is_at_exponent()) {
    refuse(start,
           "an E right after a number could begin an exponent or a word. Write the number without exponent, such as "
           "0.000099, or put a blank before the E word.");
  }
  // from_chars knows no plus sign.
  const char* first = digits.data() + (digits[0] == '+' ? 1 : 0);
  const char* last = digits.data() + length;
  double value = 0;
  const auto [end, error] = std::from_chars(first, last, value, std::chars_format::fixed);
  if (error != std::errc() || end != last) {
    refuse(start,
           "'" + std::string(digits.data(), length) + "' is not a number. Write it like -12.5, without exponent.");
  }
  return value;
}

// Right after a number: whether it goes on with E and a whole number, which other languages take for an exponent
// (9.9e-05). With a decimal point that is no exponent but a printer's E word (X10E1.5).
bool Cursor::is_at_exponent() const {
  if (at_end() || upper(peek()) != 'E' || !is_digit_or_point(text_[next_ - 1])) return false;
  const bool has_sign = next_ + 1 < text_.size() && is_sign(text_[next_ + 1]);
  const std::size_t first = next_ + (has_sign ? 2 : 1);
  const std::size_t after = std::min(text_.find_first_not_of("0123456789", first), text_.size());
  return after > first && (after == text_.size() || text_[after] != '.');
}

bool Cursor::accept(std::string_view symbol) {
  Cursor rest = *this;
  for (const char expected : symbol) {
    rest.skip_blanks();
    if (rest.at_end() || upper(rest.peek()) != expected) return false;
    rest.skip();
  }
  *this = rest;
  return true;
}

std::string Cursor::name() {
  const Place start = place();
  std::string name;
  for (; !at_end() && peek() != '>'; ++next_) {
    refuse_control_character();
    if (at_blank()) continue;
    const bool is_plain =
        static_cast<unsigned char>(peek()) < 0x7f && std::string_view("()<;").find(peek()) == std::string_view::npos;
    if (!is_plain)
      refuse(place(), "this cannot be part of a name. Use letters, digits and _, and end the name with '>'.");
    if (name.size() == kMaxNameLength) refuse(start, "the name is longer than 100 bytes. Choose a shorter one.");
    name += lower(peek());
  }
  if (at_end()) refuse(start, "the name is not closed. Add '>'.");
  if (name.empty()) refuse(start, "the name is missing. Write one between < and >, or a number without them.");
  skip();
  return name;
}

void Cursor::skip_rest() {
  for (; !at_end(); ++next_) refuse_control_character();
}

void Cursor::skip_parentheses() {
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

void Cursor::skip_comments() {
  for (skip_blanks(); !at_end(); skip_blanks()) {
    if (at(';')) {
      skip_rest();
    } else if (at('(')) {
      skip_parentheses();
    } else {
      return;
    }
  }
}

void Cursor::refuse_control_character() const {
  if (!at_end() && is_control(peek())) {
    refuse(place(), "control character " + std::to_string(peek()) +
                        ". G-code is plain text: save the program as ASCII or UTF-8.");
  }
}

void Cursor::refuse_character() const {
  refuse_control_character();
  if (is_digit_or_point(peek()) || is_sign(peek())) {
    refuse(place(), "a number without a letter. Write a word such as X1.5; an expression stands in brackets: X[1+2].");
  }
  switch (peek()) {
    case '[':
      refuse(place(), "an expression without a letter. Write a word such as X[1+2], or set a parameter: #1=[1+2].");
    case ']':
      refuse(place(), "']' without '['. Remove it, or open the expression.");
    case '=':
      refuse(place(), "'=' sets a parameter, whose number or name comes before it: #1=2.5.");
    case '*':
      refuse(place(), "'*' multiplies inside brackets only: X[2*3]. If it begins a checksum, remove that.");
    case '/':
      refuse(place(), "'/' skips a block only as the first character of its line, and divides inside brackets only.");
    case '%':
      refuse(place(), "'%' must stand alone on its line.");
    case ')':
      refuse(place(), "')' without '('. Comments are ( ) on one line, or ; to the end of the line.");
    default:
      break;
  }
  const unsigned byte = static_cast<unsigned char>(peek());
  const std::string name =
      byte > 0x20 && byte < 0x7f ? std::string("'") + peek() + "'" : "byte " + std::to_string(byte);
  refuse(place(), name + " means nothing outside a comment. Remove it.");
}

}  // namespace kcs::gcode
