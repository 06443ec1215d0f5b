// Programs for other controls: the refusal says for which.
#include "server/gcode/dialect.h"

#include <gtest/gtest.h>

#include "tests/unit/gcode/program.h"

namespace kcs::gcode {
namespace {

void expect_hint(std::string_view line, const std::string& control) {
  const std::string refusal = refusal_of("G21 G90\nG0 X1\n" + std::string(line) + "\n");
  EXPECT_TRUE(refusal.starts_with("gcode, line 3, column ")) << refusal;
  EXPECT_NE(refusal.find("This looks like " + control + "'"), std::string::npos) << line << "\n" << refusal;
  EXPECT_NE(refusal.find("post-processor for LinuxCNC"), std::string::npos) << refusal;
}

TEST(Dialect, OfHeidenhainIsNamed) {
  for (const char* line : {"0 BEGIN PGM PART MM", "1 BLK FORM 0.1 Z X+0 Y+0 Z-20", "5 TOOL CALL 1 Z S5000",
                           "7 L X+10 Y+20 R0 FMAX M3", "L Z-5 F500", "8 CC X+10 Y+10", "9 C X+20 Y+10 DR+",
                           "10 CYCL DEF 200 DRILLING", "11 LBL 1", "12 FN 0: Q1 = +5", "13 END PGM PART MM"}) {
    expect_hint(line, "Heidenhain");
  }
}

TEST(Dialect, OfSiemensIsNamed) {
  for (const char* line : {"CYCLE81(10, 0, 2, -5)", "N10 MSG(\"roughing\")", "G0 X=R1", "R1=5", "TRANS X10 Y5",
                           "G64 CONTINUOUS", "G2 X10 Y0 CR=5 F100", "IF R1>5 GOTOF END", "MCALL CYCLE83(1)",
                           "SUPA G0 Z0", "DEF REAL DEPTH", "FOR R1=1 TO 5", "ENDFOR", "ENDIF"}) {
    expect_hint(line, "Siemens");
  }
}

TEST(Dialect, OfFanucIsNamed) {
  for (const char* line : {"G65 P9010 A1", "M98 P1000 L2", "M99", "IF [#1 EQ 2] GOTO 10", "WHILE [#1 LT 5] DO1",
                           "#100=#1+2", "G05.1 Q1", "N20 IF[#1GT0]THEN #2=1"}) {
    expect_hint(line, "Fanuc");
  }
}

TEST(Dialect, IsNamedInsideSubroutinesToo) {
  const std::string refusal = refusal_of("o1 sub\nG65 P1\no1 endsub\no1 call");
  EXPECT_TRUE(refusal.starts_with("gcode, line 2, ")) << refusal;
  EXPECT_NE(refusal.find("Fanuc"), std::string::npos);
  EXPECT_NE(refusal.find("called from line 4"), std::string::npos);
}

// A server cuts what is longer.
TEST(Dialect, LeavesTheRefusalShortEnoughToArriveWhole) {
  constexpr std::size_t kMostTextBytes = 400;
  for (const char* program : {"o1 sub\nG65 P1\no1 endsub\no1 call", "o1 sub\nCYCLE81(1)\no1 endsub\no1 call",
                              "o1 sub\n5 L X+10 R0 FMAX\no1 endsub\no1 call"}) {
    const std::string refusal = refusal_of(program);
    EXPECT_NE(refusal.find("LinuxCNC"), std::string::npos) << refusal;
    EXPECT_LE(refusal.size(), kMostTextBytes) << refusal;
  }
}

TEST(Dialect, IsNotGuessedFromPlainMistakesAndComments) {
  for (const char* line : {"G1 X1", "G5 X1", "X1 X2", "G1 X1 (X=5, M99 comes next) Q", "#1=[2", "N10 G41 D1",
                           "G1 X1 F-1", "G99999 ; see CYCLE81("}) {
    EXPECT_EQ(hint_on_dialect(line), std::nullopt) << line;
  }
}

TEST(Dialect, OfFanucsProgramNumberIsRead) {
  EXPECT_EQ(refusal_of("%\nO1234 (PART)\nN10 G21 G90\nN20 G0 X1\nM30\n%"), "");
}

}  // namespace
}  // namespace kcs::gcode
