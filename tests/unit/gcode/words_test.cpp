// Text to words: what RS-274 allows in a line.
#include "server/gcode/words.h"

#include <gtest/gtest.h>

#include "tests/unit/gcode/machine.h"
#include "tests/unit/gcode/program.h"

namespace kcs::gcode {
namespace {

Words words_of(std::string_view text) { return Machine().words_of(text, 7); }

TEST(Words, ReadsNumbersOfEveryForm) {
  const Words words = words_of("X1.5 Y-.25 Z+3. I0007 J-0");
  EXPECT_EQ(words.value('X'), 1.5);
  EXPECT_EQ(words.value('Y'), -0.25);
  EXPECT_EQ(words.value('Z'), 3);
  EXPECT_EQ(words.value('I'), 7);
  EXPECT_EQ(words.value('J'), 0);
}

TEST(Words, IgnoresWhiteSpaceEvenInsideNumbers) {
  const Words words = words_of("g 0 x +0. 12\t34 y  7");
  EXPECT_EQ(words.codes().at(0).tenths, code(0));
  EXPECT_EQ(words.value('X'), 0.1234);
  EXPECT_EQ(words.value('Y'), 7);
}

TEST(Words, TakesAnEAfterABlankOrWithADecimalPointForAWord) {
  EXPECT_EQ(words_of("G1 F900.0 E1.16").value('E'), 1.16);
  EXPECT_EQ(words_of("X10 E-2").value('E'), -2);
  EXPECT_EQ(words_of("X10E1.5").value('E'), 1.5);
  EXPECT_EQ(words_of("X10E-.5").value('E'), -0.5);
  EXPECT_EQ(words_of("E5X10").value('E'), 5);
}

TEST(Words, KeepsCodesInOrderWithTheirPlaces) {
  const Words words = words_of("N10 G01 m3 G59.1");
  ASSERT_EQ(words.codes().size(), 3U);
  EXPECT_EQ(words.codes()[0].tenths, code(1));
  EXPECT_EQ(words.codes()[1].letter, 'M');
  EXPECT_EQ(words.codes()[2].tenths, code(59, 1));
  EXPECT_EQ(words.codes()[2].place.column, 12U);
  EXPECT_EQ(words.start().column, 5U);
}

TEST(Words, KeepsSettingsInOrderWithTheirPlaces) {
  const Words words = words_of("N1 #5=2.5 X1 #<Depth>=-1");
  ASSERT_EQ(words.settings().size(), 2U);
  EXPECT_EQ(words.settings()[0].parameter.number, 5);
  EXPECT_EQ(words.settings()[0].value, 2.5);
  EXPECT_EQ(words.settings()[0].place.column, 4U);
  EXPECT_EQ(words.settings()[1].parameter.name, "depth");
  EXPECT_EQ(words.settings()[1].value, -1);
  EXPECT_EQ(words.settings()[1].place.column, 14U);
  EXPECT_EQ(words.present(), letters("NX"));
  EXPECT_EQ(words.start().column, 11U);
}

TEST(Words, LeavesOutCommentsOfBothKinds) {
  const Words words = words_of("X1 (Y2; Z3) I4 ; J5 (K6");
  EXPECT_EQ(words.present(), letters("XI"));
}

TEST(Words, AcceptsAnyTextInComments) {
  EXPECT_EQ(words_of("X1 (\xC3\xA9 \xE9 % # [ ] /) ; ( \xFF").present(), letters("X"));
}

struct BadLine {
  const char* text;
  const char* field;
  const char* reason;
};

class BadLines : public testing::TestWithParam<BadLine> {};

TEST_P(BadLines, AreRefusedWithPlaceAndReason) {
  const std::string refusal = refusal_of("G21\n" + std::string(GetParam().text));
  EXPECT_TRUE(refusal.starts_with(std::string(GetParam().field) + ": ")) << refusal;
  EXPECT_NE(refusal.find(GetParam().reason), std::string::npos) << refusal;
}

INSTANTIATE_TEST_SUITE_P(Words, BadLines,
                         testing::Values(BadLine{"X", "gcode, line 2, column 2", "no number"},
                                         BadLine{"G1 XY1", "gcode, line 2, column 5", "no number"},
                                         BadLine{"X1.2.3", "gcode, line 2, column 2", "is not a number"},
                                         BadLine{"X1-2", "gcode, line 2, column 3", "in brackets"},
                                         BadLine{"X.", "gcode, line 2, column 2", "is not a number"},
                                         BadLine{"X--1", "gcode, line 2, column 2", "is not a number"},
                                         BadLine{"X+-1", "gcode, line 2, column 2", "is not a number"},
                                         BadLine{"X1 E4 E5", "gcode, line 2, column 7", "E comes twice"},
                                         BadLine{"G1 X9.9e-05 Y1", "gcode, line 2, column 5", "such as 0.000099"},
                                         BadLine{"X1.5E2", "gcode, line 2, column 2", "without exponent"},
                                         BadLine{"X1e400 E5", "gcode, line 2, column 2", "without exponent"},
                                         BadLine{"Y 1 .E+1", "gcode, line 2, column 3", "without exponent"},
                                         BadLine{"X1E", "gcode, line 2, column 4", "E has no number"},
                                         BadLine{"Xnan", "gcode, line 2, column 2", "no number"},
                                         BadLine{"Xinf", "gcode, line 2, column 2", "no number"},
                                         BadLine{"12", "gcode, line 2, column 1", "without a letter"},
                                         BadLine{"X1 X2", "gcode, line 2, column 4", "X comes twice"},
                                         BadLine{"F1 f2", "gcode, line 2, column 4", "F comes twice"},
                                         BadLine{"X1-", "gcode, line 2, column 3", "without a letter"},
                                         BadLine{"G1 X1 O100 call", "gcode, line 2, column 7", "first on its line"},
                                         BadLine{"G1 (open", "gcode, line 2, column 4", "not closed"},
                                         BadLine{"(a (b) c)", "gcode, line 2, column 4", "inside a comment"},
                                         BadLine{"G1 )", "gcode, line 2, column 4", "without '('"},
                                         BadLine{"G1 X1 /", "gcode, line 2, column 7", "first character"},
                                         BadLine{"G1 %", "gcode, line 2, column 4", "alone"},
                                         BadLine{"G1 X1*71", "gcode, line 2, column 6", "checksum"},
                                         BadLine{"G1 \xC3\xA9", "gcode, line 2, column 4", "byte 195"},
                                         BadLine{"G1 \x01", "gcode, line 2, column 4", "control character 1"},
                                         BadLine{"(\x02)", "gcode, line 2, column 2", "control character 2"},
                                         BadLine{";\x03", "gcode, line 2, column 2", "control character 3"},
                                         BadLine{"G1.55", "gcode, line 2, column 1", "no such G word"},
                                         BadLine{"G-1", "gcode, line 2, column 1", "no such G word"},
                                         BadLine{"M3.5", "gcode, line 2, column 1", "no such M word"},
                                         BadLine{"M99999999999", "gcode, line 2, column 1", "no such M word"}));

TEST(Words, RefuseANulByte) {
  EXPECT_NE(refusal_of(std::string_view("G1 X1\0Y2", 8)).find("control character 0"), std::string::npos);
}

TEST(Words, RefuseANumberWithoutEnd) {
  EXPECT_NE(refusal_of("G1 X" + std::string(400, '9')).find("too many digits"), std::string::npos);
}

}  // namespace
}  // namespace kcs::gcode
