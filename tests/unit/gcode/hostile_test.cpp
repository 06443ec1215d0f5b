// Text that no CAM program would write: it is refused or read, and a path that comes out is sound.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "tests/unit/gcode/program.h"

namespace kcs::gcode {
namespace {

constexpr std::string_view kSeed =
    "%\n(part)\nN10 G17 G20 G90 G94 G54\nG0 Z0.25 T1 M6\nX-0.5 Y0. S1000 M3\nG01 Z0. F5.\nG02 X0. Y0.5 I0.5 J0. F2.5\n"
    "X0.5 Y0. I0. J-0.5\nG21 G61\nG3 X20 Y5 R50 Z3\nG18 G2 X30 Z13 I10 K0\nG93 G1 X1 F30\nG94 F100\nG91 X2 E5\nG92 X0\n"
    "G61.1 G64 P.1\nG4 P1\nG53 G0 X0\nM84\n#1=[2*3] #<depth>=-#1\nG1 X[#1+SIN[30]] Y#<depth> Z##5220 F[1 "
    "MOD 2]\no1 sub\nX#1\no2 while [#1 GT 0]\n#1=[#1-1]\no3 if [#1 EQ 2]\no2 continue\no3 elseif [#1]\no2 break\n"
    "o3 else\nY1\no3 endif\no2 endwhile\no1 endsub [4]\no<a> do\no4 repeat [2]\no1 call [3] [#<_value>]\n"
    "o4 endrepeat\no<a> while [0]\nM30\n%\n";

bool is_sound(const Program& program) {
  for (const planning::Segment& segment : program.segments()) {
    const bool sound = segment.end.allFinite() && segment.end.cwiseAbs().maxCoeff() <= 2e7 && segment.feed > 0 &&
                       segment.tolerance >= 0 && segment.tolerance <= 1000 && segment.dwell >= 0 &&
                       (segment.stop || segment.dwell == 0) && segment.line > 0;
    if (!sound) return false;
  }
  return std::isfinite(program.chord_error);
}

// Whether the program is accepted. Throws what is neither read nor refused soundly.
bool accepts(const std::string& text) {
  const Options options{.max_segments = 20'000, .max_blocks = 2'000};
  try {
    if (is_sound(read_program(text, options))) return true;
    throw std::logic_error("read into an unsound path:\n" + text);
  } catch (const planning::InvalidInput& refusal) {
    const bool is_sound_refusal = refusal.violations().size() == 1 &&
                                  refusal.violations()[0].field.starts_with("gcode, line ") &&
                                  !refusal.violations()[0].description.empty();
    if (is_sound_refusal) return false;
    throw std::logic_error("refused without place or reason:\n" + text);
  }
}

TEST(Hostile, ChangedBytesAreReadOrRefused) {
  std::mt19937_64 random(42);
  for (int round = 0; round < 20'000; ++round) {
    std::string text(kSeed);
    const std::size_t changes = 1 + random() % 8;
    for (std::size_t change = 0; change < changes; ++change) {
      const std::size_t place = random() % text.size();
      switch (random() % 3) {
        case 0:
          text[place] = static_cast<char>(random());
          break;
        case 1:
          text.erase(place, random() % 5);
          break;
        default:
          text.insert(place, 1, static_cast<char>(random() % 128));
          break;
      }
    }
    ASSERT_NO_THROW(accepts(text)) << "round " << round << ":\n" << text;
  }
}

TEST(Hostile, ShuffledPartsOfAnExpressionAreReadOrRefused) {
  constexpr std::string_view kParts[] = {"[",  "]",   "[",  "]",    "+",     "-",       "*",          "/",
                                         "**", "MOD", "EQ", "LT",   "AND",   "1",       "2",          ".5",
                                         "99", "#1",  "#2", "#<a>", "#<_x>", "##1",     "SIN[",       "LN[",
                                         "E",  "<",   ">",  "=",    " ",     "SQRT[4]", "EXISTS[#1]", "ATAN[1]/[2]"};
  std::mt19937_64 random(44);
  std::size_t accepted = 0;
  for (int round = 0; round < 50'000; ++round) {
    std::string text = "#1=2 #<a>=3\nF600 G1 X[";
    const std::size_t count = random() % 8;
    for (std::size_t part = 0; part < count; ++part) text += kParts[random() % std::size(kParts)];
    text += "]";
    accepted += accepts(text) ? 1 : 0;
  }
  EXPECT_GT(accepted, 2000U);  // else the test reads error messages only
}

TEST(Hostile, ShuffledOWordsAreReadOrRefused) {
  constexpr std::string_view kLines[] = {"o1 sub",
                                         "o1 endsub",
                                         "o1 endsub [2]",
                                         "o1 call",
                                         "o1 call [#1]",
                                         "o1 return",
                                         "o2 sub",
                                         "o2 endsub",
                                         "o2 call",
                                         "o2 if [#1]",
                                         "o2 else",
                                         "o2 elseif [#2]",
                                         "o2 endif",
                                         "o2 endif",
                                         "o3 do",
                                         "o3 while",
                                         "o3 while [#31]",
                                         "o3 endwhile",
                                         "o3 while [#1 LT 3]",
                                         "o3 repeat [2]",
                                         "o3 endrepeat",
                                         "o3 break",
                                         "o2 break",
                                         "o3 continue",
                                         "o4 if [1]",
                                         "o4 endif",
                                         "#1=[#1+1]",
                                         "#31=[#31+1]",
                                         "G91 X#1",
                                         "G0 X#31",
                                         "G1 Y#<_value>",
                                         "#<a>=1",
                                         "o5",
                                         "M2",
                                         "%"};
  std::mt19937_64 random(45);
  std::size_t accepted = 0;
  for (int round = 0; round < 50'000; ++round) {
    std::string text = "F600 G1\n";
    const std::size_t count = random() % 10;
    for (std::size_t line = 0; line < count; ++line) text += std::string(kLines[random() % std::size(kLines)]) + "\n";
    accepted += accepts(text) ? 1 : 0;
  }
  EXPECT_GT(accepted, 1000U);  // else the test reads error messages only
}

TEST(Hostile, ShuffledWordsAreReadOrRefused) {
  constexpr std::string_view kWords[] = {
      "G0",    "G1",        "G2",      "G3",      "G4",           "G17",       "G18",     "G19",
      "G20",   "G21",       "G43",     "G53",     "G54",          "G61",       "G61.1",   "G64",
      "G80",   "G90",       "G91",     "G90.1",   "G91.1",        "G92",       "G92.1",   "G92.3",
      "G93",   "G94",       "X1",      "X-2.5",   "Y0",           "Y3",        "Z-1",     "Z.5",
      "I1",    "I-1",       "J2",      "K-.5",    "R1",           "R-3",       "P1",      "P2",
      "F60",   "F0",        "S5",      "T1",      "M0",           "M6",        "M3",      "M30",
      "M84",   "E1",        "A0",      "N5",      "X99999999999", "F.0000001", "R999999", "I0",
      "J0",    "X0",        "(c)",     ";c",      "\r\n",         "/",         "%",       "\n",
      "#1=2",  "#<a>=-#1",  "X#1",     "Y#<a>",   "X[",           "1",         "+",       "*",
      "**",    "-",         "/",       "]",       "SIN[",         "#1",        "#",       "MOD",
      "EQ",    "ATAN[1]/[", "X[#1-2]", "Y[4/#1]", "Z[1 LT 2]",    "#2=#<_x>",  "G81",     "G83",
      "G73",   "G82",       "G98",     "L2",      "Q1",           "G10",       "L20",     "G52",
      "G43.1", "H1",        "G28",     "G28.1",   "G55",          "@2",        "^45"};
  std::mt19937_64 random(43);
  std::size_t accepted = 0;
  for (int round = 0; round < 20'000; ++round) {
    std::string text = "F600\n";
    const std::size_t count = random() % 12;
    for (std::size_t word = 0; word < count; ++word) {
      text += kWords[random() % std::size(kWords)];
      text += random() % 3 == 0 ? "\n" : " ";
    }
    accepted += accepts(text) ? 1 : 0;
  }
  EXPECT_GT(accepted, 1000U);  // else the test reads error messages only
}

}  // namespace
}  // namespace kcs::gcode
