#include "server/gcode/o_word.h"

#include <algorithm>
#include <array>

namespace kcs::gcode {
namespace {

constexpr std::size_t kMaxDigits = 9;  // of a label; Fanuc's program numbers have up to 8

struct Spelling {
  std::string_view text;
  Keyword keyword;
};

// A keyword that begins with another comes before it.
constexpr std::array<Spelling, 15> kSpellings{{{"IF", Keyword::kIf},
                                               {"ELSEIF", Keyword::kElseIf},
                                               {"ELSE", Keyword::kElse},
                                               {"ENDIF", Keyword::kEndIf},
                                               {"WHILE", Keyword::kWhile},
                                               {"ENDWHILE", Keyword::kEndWhile},
                                               {"DO", Keyword::kDo},
                                               {"REPEAT", Keyword::kRepeat},
                                               {"ENDREPEAT", Keyword::kEndRepeat},
                                               {"BREAK", Keyword::kBreak},
                                               {"CONTINUE", Keyword::kContinue},
                                               {"CALL", Keyword::kCall},
                                               {"RETURN", Keyword::kReturn},
                                               {"SUB", Keyword::kSub},
                                               {"ENDSUB", Keyword::kEndSub}}};

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(c - 'A' + 'a');
  return result;
}

std::string read_number(Cursor& cursor) {
  const Place start = cursor.place();
  std::string digits;
  for (cursor.skip_blanks(); cursor.at_digit(); cursor.skip_blanks()) {
    if (digits.size() == kMaxDigits) refuse(start, "the number after O has more than 9 digits. Choose a smaller one.");
    digits += cursor.peek();
    cursor.skip();
  }
  if (digits.empty()) {
    refuse(start, "O takes a number (o100) or a name (o<slot>), which cannot be computed. Write one here.");
  }
  return digits.substr(std::min(digits.find_first_not_of('0'), digits.size() - 1));
}

Keyword read_keyword(Cursor& cursor) {
  for (const Spelling& spelling : kSpellings) {
    if (cursor.accept(spelling.text)) return spelling.keyword;
  }
  cursor.skip_blanks();
  if (cursor.at_end() || cursor.at('(') || cursor.at(';')) return Keyword::kNone;
  refuse(cursor.place(),
         "an O word goes on with sub, endsub, call, return, if, elseif, else, endif, while, endwhile, do, repeat, "
         "endrepeat, break or continue. Write one of these here.");
}

}  // namespace

std::string name_of(const std::string& label) {
  const bool is_number = label.find_first_not_of("0123456789") == std::string::npos;
  return is_number ? "o" + label : "o<" + label + ">";
}

std::string OWord::text(Keyword other) const {
  const auto* spelling =
      std::find_if(kSpellings.begin(), kSpellings.end(), [&](const Spelling& s) { return s.keyword == other; });
  return name_of(label) + (spelling == kSpellings.end() ? "" : " " + lower_case(spelling->text));
}

bool begins_with_o_word(std::string_view line) {
  Cursor cursor(line, 0);
  cursor.skip_blanks();
  if (cursor.at('N') || cursor.at('n')) {
    cursor.skip();
    while (cursor.at_digit() || cursor.at('.') || cursor.at_blank()) cursor.skip();
  }
  return cursor.at('O') || cursor.at('o');
}

OWord read_o_word(Cursor& cursor) {
  if (cursor.accept("N")) {
    cursor.skip_blanks();
    if (cursor.at_number()) cursor.number();
  }
  cursor.skip_blanks();
  OWord word;
  word.place = cursor.place();
  cursor.skip();
  word.label = cursor.accept("<") ? cursor.name() : read_number(cursor);
  word.keyword = read_keyword(cursor);
  return word;
}

}  // namespace kcs::gcode
