// What a block may hold together, and what is refused or noted.
#include "server/gcode/codes.h"

#include <gtest/gtest.h>

#include "tests/unit/gcode/program.h"

namespace kcs::gcode {
namespace {

class RefusedCodes : public testing::TestWithParam<const char*> {};

TEST_P(RefusedCodes, NameThemselvesAndTheirPlace) {
  const std::string word = GetParam();
  const std::string refusal = refusal_of("G0 X1\nN1 " + word + "\n");
  EXPECT_TRUE(refusal.starts_with("gcode, line 2, column 4: " + word + ": ")) << refusal;
}

INSTANTIATE_TEST_SUITE_P(Codes, RefusedCodes,
                         testing::Values("G5", "G5.1", "G7", "G28", "G30", "G33", "G38.2", "G41", "G41.1", "G42",
                                         "G42.1", "G71", "G74", "G76", "G84", "G87", "G88", "G95", "G1000", "M98",
                                         "M99"));

TEST(Codes, SaysWhatToDoInsteadOfG28) {
  EXPECT_NE(refusal_of("G28 Z0").find("write the position as a move, such as G53 G0 Z0"), std::string::npos);
}

class ExclusiveCodes : public testing::TestWithParam<const char*> {};

TEST_P(ExclusiveCodes, AreRefusedInOneBlock) {
  EXPECT_NE(refusal_of(GetParam()).find("exclude each other in one block"), std::string::npos) << GetParam();
}

INSTANTIATE_TEST_SUITE_P(Codes, ExclusiveCodes,
                         testing::Values("G0 G1 X1", "G1 G1 X1", "G80 G0", "G17 G18", "G20 G21", "G90 G91",
                                         "G90.1 G91.1", "G93 G94", "G54 G55", "G61 G64", "G40 G40", "G43 G49",
                                         "G81 G83", "G4 P1 G92 X0", "M3 M5", "M8 M9", "M0 M2", "M6 M6", "G98 G99",
                                         "G96 G97", "M48 M49"));

TEST(Codes, OfDifferentGroupsGoTogether) {
  EXPECT_EQ(refusal_of("G17 G21 G40 G49 G54 G61 G80 G90 G91.1 G94 G97 M5 M9 M48"), "");
}

TEST(Codes, WithoutEffectAreNoted) {
  const struct {
    const char* word;
    const char* note;
  } cases[] = {{"G43 H1", "Tool lengths"}, {"G43", "Tool lengths"},   {"H3", "H words"},  {"D08", "Tool radii"},
               {"G54", "Work offsets"},    {"G59.3", "Work offsets"}, {"T1 M6", "Tools"}, {"M49", "M48 and M49"},
               {"M106 S255", "M106"},      {"E5", "E words"},         {"Q1", "Q words"},  {"L1", "L words"}};
  for (const auto& [word, note] : cases) {
    const Program program = read_program("G0 X1\nX2 Y0\n" + std::string(word));
    ASSERT_EQ(program.notices.size(), 1U) << word;
    EXPECT_TRUE(program.notices[0].text.starts_with(note)) << program.notices[0].text;
    EXPECT_EQ(program.notices[0].line, 3U);
    EXPECT_EQ(program.notices[0].count, 1U);
    EXPECT_EQ(program.segments().size(), 2U);
  }
}

TEST(Codes, OfOrdinaryProgramsAreNotNoted) {
  EXPECT_TRUE(read_program("N1 G17 G21 G40 G64 P.1 G80 G90 G94\nG0 X1 S100 M3\nG1 Y1 F60 M8\nM0\nM30").notices.empty());
}

TEST(Codes, AnUnknownMWordTakesItsBlockWithIt) {
  EXPECT_EQ(read_program("G0 X1\nM62 P1\nM100 S5 E9").segments().size(), 1U);
}

TEST(Codes, AnUnknownMWordDoesNotHideAMove) {
  EXPECT_TRUE(refusal_of("G1 X1 F60\nM62 P1 X20").starts_with("gcode, line 2, column 8: M62 is not known to kcs"));
  EXPECT_TRUE(refusal_of("G0\nN5 M100 P1 Z20").starts_with("gcode, line 2, column 12: M100 is not known to kcs"));
  EXPECT_TRUE(refusal_of("F60 G2 I1\nM62 P1 I5").starts_with("gcode, line 2, column 8: M62 is not known to kcs"));
}

class PrinterSettings : public testing::TestWithParam<const char*> {};

TEST_P(PrinterSettings, OfAxesAreSkippedAndSaidToBe) {
  const std::string word = GetParam();
  const Program program = read_program("G0 X1\nN1 " + word + " X500 Z0 E9 P1\n" + word + " Y5");
  EXPECT_EQ(program.segments().size(), 1U);
  ASSERT_EQ(program.notices.size(), 2U);
  EXPECT_EQ(program.notices[0].text, word + " is not known to kcs and was skipped.");
  EXPECT_TRUE(program.notices[1].text.starts_with("Axis words (X, Z) beside " + word + " were skipped with it"));
  EXPECT_EQ(program.notices[1].line, 2U);
  EXPECT_EQ(program.notices[1].count, 2U);
}

INSTANTIATE_TEST_SUITE_P(Codes, PrinterSettings,
                         testing::Values("M92", "M201", "M203", "M204", "M205", "M206", "M350", "M566", "M900", "M906",
                                         "M907"));

TEST(Codes, AnUnknownMWordBeforeAnyMotionTakesItsAxisWordsWithItAndSaysSo) {
  const Program program = read_program("M555 X80 Y80\nG0 X1");
  EXPECT_EQ(program.segments().size(), 1U);
  ASSERT_EQ(program.notices.size(), 2U);
  EXPECT_TRUE(program.notices[1].text.starts_with("Axis words (X, Y) beside M555 were skipped"));
}

TEST(Codes, AnUnknownMWordAfterAMoveLeavesTheMove) {
  EXPECT_EQ(read_program("G0 X1 M106").end().x(), 1);
  EXPECT_EQ(read_program("G0\nX1 M106 P1").end().x(), 1);
  EXPECT_EQ(read_program("M106 G0 X1").end().x(), 1);
}

TEST(Codes, AnUnknownMWordDoesNotHideTheProgramsEnd) { EXPECT_EQ(read_program("G0 X1\nM84 M30\nX2").end().x(), 1); }

TEST(Codes, WordsWithoutUseAreRefused) {
  EXPECT_NE(refusal_of("G1 X1 I2 F60").find("column 7: a word without use"), std::string::npos);
  EXPECT_NE(refusal_of("G0 X1 R2").find("column 7"), std::string::npos);
  EXPECT_NE(refusal_of("G0 X1 P2").find("column 7"), std::string::npos);
  EXPECT_NE(refusal_of("G92 X1 I2"), "");
  EXPECT_NE(refusal_of("G64 P1 G2 X2 R1 F60").find("more than one word"), std::string::npos);
  EXPECT_EQ(refusal_of("F60 G2\nG64 P1\nG4 P1"), "");
}

}  // namespace
}  // namespace kcs::gcode
