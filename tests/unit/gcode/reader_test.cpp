// What belongs to the program as a whole: lines, pieces, its beginning and end.
#include "server/gcode/reader.h"

#include <gtest/gtest.h>

#include <random>

#include "server/gcode/cap_reached.h"
#include "tests/unit/gcode/program.h"

namespace kcs::gcode {
namespace {

constexpr std::string_view kProgram =
    "%\r\n(a part)\r\nG21 G90 G94 ; metric\r\nG0 X1 Y2\nG1 Z-1 F600\rX10\r\r\nG2 X20 Y12 I10 J0\n\n"
    "/G1 X99\nG91 G1 X1 E2\nG90 G3 Y0 R-8 F1200\nG4 P.5\nM30\n%\n";

constexpr std::string_view kProgramWithOWords =
    "%\nO0042 (a part)\no<row> sub\no1 repeat [#1]\nG91 G0 X1\r\n/X7\no1 endrepeat\n\no<row> endsub [#1]\nG0 Y1\n"
    "#<i>=0\no1 while [#<i> LT 3]\n#<i>=[#<i>+1]\ro2 if [#<i> EQ 2]\no1 continue\no2 endif\no<row> call [#<i>]\n"
    "G0 Y#<_value>\no1 endwhile\no3 if [1]\nG0 Z1\no3 endif\nM2\n%\n";

void expect_same(const Program& a, const Program& b) {
  ASSERT_EQ(a.segments().size(), b.segments().size());
  for (std::size_t i = 0; i < a.segments().size(); ++i) {
    EXPECT_EQ(a.segments()[i].end, b.segments()[i].end) << i;
    EXPECT_EQ(a.segments()[i].feed, b.segments()[i].feed) << i;
    EXPECT_EQ(a.segments()[i].line, b.segments()[i].line) << i;
    EXPECT_EQ(a.segments()[i].stop, b.segments()[i].stop) << i;
  }
  ASSERT_EQ(a.notices.size(), b.notices.size());
  for (std::size_t i = 0; i < a.notices.size(); ++i) {
    EXPECT_EQ(a.notices[i].text, b.notices[i].text);
    EXPECT_EQ(a.notices[i].line, b.notices[i].line);
    EXPECT_EQ(a.notices[i].count, b.notices[i].count);
  }
}

Program read_in_pieces(std::string_view text, std::mt19937_64& random, std::size_t longest) {
  Program program;
  Reader reader({}, into(program.path));
  while (!text.empty()) {
    const std::size_t length = std::min<std::size_t>(text.size(), random() % (longest + 1));
    reader.read(text.substr(0, length));
    text.remove_prefix(length);
  }
  reader.finish();
  program.notices = reader.notices();
  return program;
}

TEST(Reader, GivesTheSamePathHoweverTheProgramIsCut) {
  std::mt19937_64 random(1);
  for (const std::string_view program : {kProgram, kProgramWithOWords}) {
    const Program whole = read_program(program);
    EXPECT_GE(whole.segments().size(), 8U);
    for (int round = 0; round < 300; ++round) expect_same(whole, read_in_pieces(program, random, 1 + round % 20));
  }
}

TEST(Reader, CountsLinesAlikeWithEveryLineEnd) {
  for (const char* end : {"\n", "\r\n", "\r"}) {
    const std::string program = std::string("G21") + end + end + "G0 X1" + end + "G0 X2";
    const Program read = read_program(program);
    ASSERT_EQ(read.segments().size(), 2U);
    EXPECT_EQ(read.segments()[0].line, 3U);
    EXPECT_EQ(read.segments()[1].line, 4U);
  }
}

TEST(Reader, ReadsTheLastLineWithoutAnEnd) { EXPECT_EQ(read_program("G0 X1\nG0 X2").end().x(), 2); }

TEST(Reader, RefusesALineThatIsTooLongWithoutKeepingIt) {
  Reader reader({}, [](const planning::Segment&) {});
  const std::string piece(1000, ' ');
  EXPECT_THROW(
      {
        for (int i = 0; i < 66; ++i) reader.read(piece);
      },
      planning::InvalidInput);
  EXPECT_TRUE(refusal_of("G21\n(" + std::string(kMaxLineLength, 'x') + ")\n").starts_with("gcode, line 2, column 1"));
  EXPECT_EQ(refusal_of("(" + std::string(kMaxLineLength - 2, 'x') + ")\n"), "");
}

TEST(Reader, SkipsAByteOrderMarkAtTheBeginningOnly) {
  EXPECT_EQ(read_program("\xEF\xBB\xBFG0 X1").end().x(), 1);
  EXPECT_NE(refusal_of("G0 X1\n\xEF\xBB\xBFG0 X1"), "");
}

TEST(Reader, SkipsDeletedBlocksAndSaysSo) {
  const Program program = read_program("G0 X1\n / G0 X5 [\n/G0 X6");
  EXPECT_EQ(program.end().x(), 1);
  ASSERT_EQ(program.notices.size(), 1U);
  EXPECT_EQ(program.notices[0].line, 2U);
  EXPECT_EQ(program.notices[0].count, 2U);
}

TEST(Reader, EndsAtTheSecondPercentSign) {
  const Program program = read_program("\n(part)\n % \nG0 X1\n%\nG0 X2");
  EXPECT_EQ(program.end().x(), 1);
  ASSERT_EQ(program.notices.size(), 1U);
  EXPECT_EQ(program.notices[0].line, 6U);
}

TEST(Reader, EndsAtAPercentSignAfterAProgramWithoutAFirst) {
  EXPECT_EQ(read_program("G0 X1\n%\n \n;x").notices.size(), 0U);
  EXPECT_EQ(read_program("G0 X1\n%\nG0 X2").end().x(), 1);
}

TEST(Reader, RefusesWordsBesideAPercentSign) {
  EXPECT_EQ(refusal_of("% (start)\nG0 X1\n%;end"), "");
  EXPECT_TRUE(refusal_of("%MPF 100\n").starts_with("gcode, line 1, column 2"));
}

TEST(Reader, EndsTheProgramAtM2AndM30) {
  for (const char* end : {"M2", "M30"}) {
    const Program program = read_program("G0 X1\n" + std::string(end) + "\nG0 X2\nG0 X3\n[garbage\n%\n");
    ASSERT_EQ(program.segments().size(), 1U);
    EXPECT_TRUE(program.segments()[0].stop);
    ASSERT_EQ(program.notices.size(), 1U);
    EXPECT_EQ(program.notices[0].line, 3U);
    EXPECT_EQ(program.notices[0].count, 3U);
  }
}

TEST(Reader, MovesBeforeItEndsInTheSameBlock) { EXPECT_EQ(read_program("M30 G0 X1").end().x(), 1); }

TEST(Reader, CountsNoticesOfOneKindOnce) {
  const Program program = read_program("G1 X1 F60 E1\nG1 X2 E2\nM82\nM84\nG1 X3 E3\nM82");
  ASSERT_EQ(program.notices.size(), 3U);
  EXPECT_EQ(program.notices[0].text, "E words are not known to kcs and were skipped.");
  EXPECT_EQ(program.notices[0].line, 1U);
  EXPECT_EQ(program.notices[0].count, 3U);
  EXPECT_EQ(program.notices[1].text, "M82 is not known to kcs and was skipped.");
  EXPECT_EQ(program.notices[1].count, 2U);
  EXPECT_EQ(program.notices[2].line, 4U);
}

TEST(Reader, StopsAtTheCapOnSegmentsAndNamesIt) {
  Options options;
  options.max_segments = 3;
  EXPECT_EQ(read_program("G0 X1\nX2\nX3", options).segments().size(), 3U);
  EXPECT_THROW(read_program("G0 X1\nX2\nX3\nX4", options), CapReached);
  EXPECT_NE(
      refusal_of("G0 X1\nX2\nX3\nX4", options).find("gcode, line 4, column 1: the program has more than 3 segments"),
      std::string::npos);
}

TEST(Reader, StopsAtTheCapOnChordsAndNamesIt) {
  Options options;
  options.max_chords = 10;
  EXPECT_THROW(read_program("G2 I100 F60", options), CapReached);
  EXPECT_THROW(read_program("G64 P0.0000000000000000000000001\nG2 I100 P1000000 F60"), planning::InvalidInput);
  EXPECT_THROW(read_program("G2 I100 P1000000 F60"), CapReached);
}

}  // namespace
}  // namespace kcs::gcode
