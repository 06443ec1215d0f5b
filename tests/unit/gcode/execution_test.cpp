// The order in which lines are executed, what is kept of them, and how far they may go.
#include "server/gcode/execution.h"

#include <gtest/gtest.h>

#include "server/gcode/cap_reached.h"
#include "tests/unit/gcode/program.h"

namespace kcs::gcode {
namespace {

// The cap that reading the program reaches.
Cap cap_of(std::string_view program, const Options& options) {
  try {
    read_program(program, options);
  } catch (const CapReached& reached) {
    return reached.cap();
  }
  return {};
}

TEST(Execution, RunsTheFirstRoundOfALoopWhileItComes) {
  planning::Toolpath path;
  Reader reader({}, into(path));
  reader.read("o1 repeat [2]\nG0 X1\nX2\n");
  EXPECT_EQ(path.segments.size(), 1U);
  reader.read("o1 endrepeat\n");
  EXPECT_EQ(path.segments.size(), 3U);
  reader.finish();
  EXPECT_EQ(path.segments.size(), 4U);
}

TEST(Execution, LeavesDeletedBlocksOutOfLoopsAndSubroutines) {
  const Program program =
      read_program("o1 sub\n/G0 X1\nG0 X2\no1 endsub\no2 repeat [2]\n/G0 X3\no1 call\n\no2 endrepeat");
  EXPECT_EQ(x_of(program), (std::vector<double>{2}));
  ASSERT_EQ(program.notices.size(), 1U);
  EXPECT_EQ(program.notices[0].count, 2U);
}

TEST(Execution, KnowsTheLinesOfTheProgramsText) {
  EXPECT_EQ(
      x_of(read_program("o1 sub\nG0 X#<_line>\n\no1 endsub\n\no2 repeat [2]\nG0 X#<_line>\no1 call\no2 endrepeat")),
      (std::vector<double>{7, 2, 7, 2}));
}

TEST(Execution, TakesALoneOWordInFrontForAProgramNumber) {
  for (const char* header : {"%\nO1234\n", "o0001 (TITLE)\n", "%\n(c)\n\nO<part> ; c\n"}) {
    const Program program = read_program(std::string(header) + "G0 X1\nM30\n%\n");
    EXPECT_EQ(x_of(program), (std::vector<double>{1}));
    ASSERT_EQ(program.notices.size(), 1U);
    EXPECT_TRUE(program.notices[0].text.starts_with("The program number (o")) << program.notices[0].text;
  }
  EXPECT_EQ(read_program("%\nO1234\nM30").notices[0].line, 2U);
}

TEST(Execution, RefusesAProgramNumberBehindTheFirstBlock) {
  const std::string reason = "stands alone, which makes it a program number: that comes first in a program.";
  EXPECT_NE(refusal_of("G0 X1\nO1234").find("gcode, line 2, column 1: o1234 " + reason), std::string::npos);
  EXPECT_NE(refusal_of("O1\nO2").find("gcode, line 2, column 1: o2 " + reason), std::string::npos);
  EXPECT_NE(refusal_of("#1=1\nO2").find(reason), std::string::npos);
  EXPECT_NE(refusal_of("o1 if [0]\nO2\no1 endif").find(reason), std::string::npos);
}

TEST(Execution, CountsOWordsAsABeginningOfTheProgram) {
  EXPECT_EQ(x_of(read_program("o1 sub\no1 endsub\n%\nG0 X1")), (std::vector<double>{}));
}

TEST(Execution, StopsAtTheCapOnKeptText) {
  Options options;
  options.max_kept_bytes = 1000;
  std::string body;
  for (int line = 0; line < 100; ++line) body += "G0 X" + std::to_string(line + 10) + "\n";
  EXPECT_EQ(cap_of("o1 repeat [1]\n" + body + "o1 endrepeat", options).name, "max_kept_bytes");
  EXPECT_EQ(cap_of("o1 sub\n" + body + "o1 endsub", options).value, 1000U);
  const std::string small = body.substr(0, 7 * 25);
  std::string subs;
  for (char name = 'a'; name <= 'e'; ++name) {
    subs += std::string("o<") + name + "> sub\n" + small + "o<" + name + "> endsub\n";
  }
  EXPECT_TRUE(refusal_of(subs, options).starts_with("gcode, line ")) << "subroutines count together";
  EXPECT_NE(refusal_of(subs, options).find("more than 1000 bytes (the cap max_kept_bytes)"), std::string::npos);
  std::string loops;
  for (int loop = 0; loop < 50; ++loop) loops += "o1 repeat [2]\n" + small + "o1 endrepeat\n" + small;
  EXPECT_EQ(refusal_of(loops, options), "") << "a loop that is over is forgotten";
}

TEST(Execution, StopsAtTheCapOnBlocks) {
  Options options;
  options.max_blocks = 100;
  EXPECT_EQ(refusal_of("o1 repeat [49]\no1 endrepeat", options), "");
  EXPECT_EQ(cap_of("o1 repeat [200]\no1 endrepeat", options).name, "max_blocks");
  const std::string refusal = refusal_of("G0 X1\no1 while [1]\n#1=[#1+1]\no1 endwhile", options);
  EXPECT_TRUE(refusal.starts_with("gcode, line ")) << refusal;
  EXPECT_NE(refusal.find("more than 100 blocks (the cap max_blocks). Check that this loop ends"), std::string::npos);
  const std::string line = "#1=1 (" + std::string(320, 'x') + ")\n";
  EXPECT_EQ(cap_of("o1 repeat [10]\n" + line + "o1 endrepeat", options).name, "max_blocks") << "long lines count more";
  std::string plain;
  for (int i = 1; i <= 1000; ++i) plain += "G0 X" + std::to_string(i) + "\n";
  EXPECT_EQ(refusal_of(plain, options), "");
}

TEST(Execution, NamesTheCapInsideASubroutineToo) {
  Options options;
  options.max_segments = 2;
  const std::string program = "o1 sub\nG0 X1\nG0 X0\no1 endsub\no1 call\no1 call";
  EXPECT_EQ(cap_of(program, options).name, "max_segments");
  EXPECT_EQ(cap_of(program, options).value, 2U);
  EXPECT_TRUE(refusal_of(program, options).ends_with("This is in o1, called from line 6."));
}

TEST(Execution, CountsTheNamesOfCallsThatRun) {
  Options options;
  options.max_names = 10;
  const std::string sub = "o1 sub\n#<a>=1 #<b>=2\no2 if [#1 GT 1]\no1 call [#1-1]\no2 endif\no1 endsub\n";
  EXPECT_EQ(refusal_of(sub + "o3 repeat [20]\no1 call [5]\no3 endrepeat", options), "");
  EXPECT_EQ(cap_of(sub + "o1 call [6]", options).name, "max_names");
}

}  // namespace
}  // namespace kcs::gcode
