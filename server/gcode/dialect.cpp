#include "server/gcode/dialect.h"

#include <array>
#include <string>

namespace kcs::gcode {
namespace {

constexpr std::string_view kHeidenhain =
    "This looks like Heidenhain's conversational language. Use the CAM program's post-processor for LinuxCNC: "
    "L X+10 F500 is G1 X10 F500, FMAX is G0, CC and C are G2 or G3 with I and J, CYCL DEF is G81 to G89.";
constexpr std::string_view kSiemens =
    "This looks like Siemens' language (Sinumerik). Use the CAM program's post-processor for LinuxCNC: "
    "R1=5 is #1=5, X=R1 is X#1, CYCLE81 is G81, TRANS is G52, MSG is a comment, IF and GOTOF are o100 if.";
constexpr std::string_view kFanuc =
    "This looks like Fanuc's macro language. Use the CAM program's post-processor for LinuxCNC: M98 P100 is o100 call, "
    "with o100 sub and o100 endsub before it, IF and GOTO are o100 if, WHILE is o100 while, G05.1 is G64 P.";

// Words are searched in the line in upper case, without comments and blanks, where a blank in a word stands for the
// beginning of the line, behind its number.
struct Mark {
  std::string_view word;
  std::string_view hint;
};

constexpr std::array<Mark, 47> kMarks{{
    {" BEGINPGM", kHeidenhain}, {" ENDPGM", kHeidenhain}, {"TOOLCALL", kHeidenhain},
    {"TOOLDEF", kHeidenhain},   {"CYCLDEF", kHeidenhain}, {"CYCLCALL", kHeidenhain},
    {"FMAX", kHeidenhain},      {"BLKFORM", kHeidenhain}, {" CALLLBL", kHeidenhain},
    {" LBL", kHeidenhain},      {"DR+", kHeidenhain},     {"DR-", kHeidenhain},
    {" CCX", kHeidenhain},      {" LX", kHeidenhain},     {" LY", kHeidenhain},
    {" LZ", kHeidenhain},       {" FN", kHeidenhain},     {"CYCLE", kSiemens},
    {"MSG(", kSiemens},         {" TRANS", kSiemens},     {" ATRANS", kSiemens},
    {" ROT", kSiemens},         {"GOTOF", kSiemens},      {"GOTOB", kSiemens},
    {"CONTINUOUS", kSiemens},   {"X=", kSiemens},         {"Y=", kSiemens},
    {"Z=", kSiemens},           {" R0=", kSiemens},       {" R1=", kSiemens},
    {"MCALL", kSiemens},        {"DEFREAL", kSiemens},    {"DEFINT", kSiemens},
    {"SUPA", kSiemens},         {"WORKPIECE(", kSiemens}, {"CR=", kSiemens},
    {"G65P", kFanuc},           {"M98", kFanuc},          {"M99", kFanuc},
    {"GOTO", kFanuc},           {"]DO", kFanuc},          {"]THEN", kFanuc},
    {"G05.1Q", kFanuc},         {"G5.1Q", kFanuc},        {" FOR", kSiemens},
    {" ENDFOR", kSiemens},      {" ENDIF", kSiemens},
}};

// Fanuc computes without brackets: #1=#2+1.
bool computes_without_brackets(std::string_view text) {
  const std::size_t equals = text.find('=');
  return text.starts_with(" #") && equals != std::string_view::npos &&
         text.find_first_of("+-*/", equals + 2) != std::string_view::npos && text.find('[') == std::string_view::npos;
}

// The line as the marks are written, cut short where it is long.
std::string plain(std::string_view line) {
  constexpr std::size_t kEnough = 200;
  std::string text = " ";
  bool in_comment = false;
  char before = ' ';
  for (const char c : line.substr(0, kEnough)) {
    if (c == ';') break;
    // Behind a word, parentheses hold the values of a cycle or a message.
    if (c == '(' && (before == ' ' || before == '\t')) in_comment = true;
    if (!in_comment && c != ' ' && c != '\t') text += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    if (c == ')') in_comment = false;
    before = c;
  }
  const std::size_t number = text.size() > 1 && text[1] == 'N' ? 2 : 1;
  const std::size_t after = text.find_first_not_of("0123456789", number);
  if (after != std::string::npos && after > number) text.erase(1, after - 1);
  return text;
}

}  // namespace

std::optional<std::string_view> hint_on_dialect(std::string_view line) {
  const std::string text = plain(line);
  for (const Mark& mark : kMarks) {
    if (text.find(mark.word) != std::string::npos) return mark.hint;
  }
  if (computes_without_brackets(text)) return kFanuc;
  return std::nullopt;
}

}  // namespace kcs::gcode
