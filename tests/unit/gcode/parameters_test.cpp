// What a program sets and reads again.
#include "server/gcode/parameters.h"

#include <gtest/gtest.h>

#include <string>

#include "server/gcode/cap_reached.h"
#include "tests/unit/gcode/machine.h"
#include "tests/unit/gcode/program.h"

namespace kcs::gcode {
namespace {

TEST(Parameters, KeepWhatTheyAreSetTo) {
  Machine machine;
  machine.run("#1=2.5 #5060=-7");
  EXPECT_EQ(machine.value_of("#1"), 2.5);
  EXPECT_EQ(machine.value_of("#5060"), -7);
  machine.run("#1=3");
  EXPECT_EQ(machine.value_of("#1"), 3);
}

TEST(Parameters, AreZeroUntilTheyAreSet) {
  Machine machine;
  machine.run("#7=1");
  EXPECT_EQ(machine.value_of("#6"), 0);
  EXPECT_EQ(machine.value_of("#5060"), 0);
}

TEST(Parameters, OfALineAreSetWhenAllItsValuesAreRead) {
  Machine machine;
  machine.run("#1=5");
  machine.run("#1=10 #2=#1");
  EXPECT_EQ(machine.value_of("#1"), 10);
  EXPECT_EQ(machine.value_of("#2"), 5);
  machine.run("#1=#2 #2=#1");
  EXPECT_EQ(machine.value_of("#1"), 5);
  EXPECT_EQ(machine.value_of("#2"), 10);
}

TEST(Parameters, OfALineDoNotChangeItsMove) {
  const Program program = read_program("#3=6 F600\nG1 X#3 #3=7\nX[#3*2]");
  ASSERT_EQ(program.segments().size(), 2U);
  EXPECT_EQ(program.segments()[0].end.x(), 6);
  EXPECT_EQ(program.segments()[1].end.x(), 14);
}

TEST(Parameters, SetTwiceInALineKeepTheLastValue) {
  Machine machine;
  machine.run("#1=1 #1=2 #<a>=3 #<a>=4");
  EXPECT_EQ(machine.value_of("#1"), 2);
  EXPECT_EQ(machine.value_of("#<a>"), 4);
}

TEST(Parameters, CanBeNumberedByValues) {
  Machine machine;
  machine.run("#2=4 #4=11");
  EXPECT_EQ(machine.value_of("##2"), 11);
  EXPECT_EQ(machine.value_of("#[#2]"), 11);
  EXPECT_EQ(machine.value_of("#[1+3]"), 11);
  EXPECT_EQ(machine.value_of("#SQRT[16]"), 11);
  EXPECT_EQ(machine.value_of("#3.99995"), 11);
  machine.run("##2=12 #[#2+1]=13");
  EXPECT_EQ(machine.value_of("#4"), 12);
  EXPECT_EQ(machine.value_of("#5"), 13);
}

TEST(Parameters, HaveNamesWhoseCaseAndBlanksDoNotMatter) {
  Machine machine;
  machine.run("#<Hole Depth>=4 #<_global>=5 # < 1st-hole.x > = 6");
  EXPECT_EQ(machine.value_of("#<holedepth>"), 4);
  EXPECT_EQ(machine.value_of("#< HOLE DEPTH >"), 4);
  EXPECT_EQ(machine.value_of("#<_Glo bal>"), 5);
  EXPECT_EQ(machine.value_of("#<1st-hole.x>"), 6);
}

TEST(Parameters, ServeEveryLetter) {
  const Program program =
      read_program("#1=1 #2=64 #<f>=600\nG[#1+20] G90 G#1 X#1 Y-#1 Z[#1/4] F#<f>\nG#2 P[#1/8]\nN#1 X2");
  ASSERT_EQ(program.segments().size(), 2U);
  EXPECT_EQ(program.segments()[0].end, planning::Vector(1, -1, 0.25));
  EXPECT_EQ(program.segments()[0].feed, 10);
  EXPECT_EQ(program.segments()[1].tolerance, 0.125);
}

TEST(Parameters, ExistIfTheyCanBeRead) {
  Machine machine;
  machine.run("#<a>=0");
  EXPECT_EQ(machine.value_of("EXISTS[#<a>]"), 1);
  EXPECT_EQ(machine.value_of("EXISTS[ #< A > ]"), 1);
  EXPECT_EQ(machine.value_of("EXISTS[#<b>]"), 0);
  EXPECT_EQ(machine.value_of("EXISTS[#7]"), 1);
  EXPECT_EQ(machine.value_of("EXISTS[#<_x>]"), 1);
}

TEST(Parameters, AloneOnALineBeginAProgram) { EXPECT_EQ(read_program("#1=2\nG0 X1\n%\nX#1\n").segments().size(), 1U); }

struct BadParameter {
  const char* line;
  int column;
  const char* reason;
};

class BadParameters : public testing::TestWithParam<BadParameter> {};

TEST_P(BadParameters, AreRefusedWithPlaceAndReason) {
  const std::string refusal = refusal_of("G21\n" + std::string(GetParam().line));
  EXPECT_TRUE(refusal.starts_with("gcode, line 2, column " + std::to_string(GetParam().column) + ": ")) << refusal;
  EXPECT_NE(refusal.find(GetParam().reason), std::string::npos) << refusal;
}

INSTANTIATE_TEST_SUITE_P(
    Parameters, BadParameters,
    testing::Values(BadParameter{"G0 X#<depth>", 5, "#<depth> is not set"},
                    BadParameter{"#<a>=[#<a>+1]", 7, "#<a> is not set"},
                    BadParameter{"X#0", 3, "no parameter number 0"},
                    BadParameter{"X[#-1]", 4, "no parameter number -1"}, BadParameter{"X#5603", 3, "1 to 5602"},
                    BadParameter{"X#[1/2]", 3, "whole numbers"}, BadParameter{"X#[9**99]", 3, "whole numbers"},
                    BadParameter{"#0=1", 2, "no parameter number 0"}, BadParameter{"X##1", 3, "no parameter number 0"},
                    BadParameter{"# comment", 3, "its number (#5) or its name"},
                    BadParameter{"X#", 3, "its number (#5) or its name"}, BadParameter{"#5", 1, "#5 stands alone"},
                    BadParameter{"G0 #<a> X1", 4, "#<a> stands alone"}, BadParameter{"#5=", 4, "#5 is set to nothing"},
                    BadParameter{"#5=X", 4, "#5 is set to nothing"}, BadParameter{"X=5", 2, "'=' sets a parameter"},
                    BadParameter{"#1=2+3", 5, "in brackets"}, BadParameter{"#<a", 3, "not closed"},
                    BadParameter{"#<>=1", 3, "name is missing"}, BadParameter{"#<a(b)>=1", 4, "part of a name"},
                    BadParameter{"#<\xC3\xA9>=1", 3, "part of a name"}, BadParameter{"#<a\x01>=1", 4, "control"}));

TEST(Parameters, RefuseANameThatIsTooLong) {
  const std::string longest(kMaxNameLength, 'a');
  EXPECT_EQ(refusal_of("#<" + longest + ">=1"), "");
  EXPECT_NE(refusal_of("#<" + longest + "a>=1").find("longer than 100 bytes"), std::string::npos);
}

TEST(Parameters, WithTooManyNamesReachACap) {
  Machine machine(2);
  machine.run("#<a>=1 #<b>=2");
  machine.run("#<a>=3");
  EXPECT_THROW(machine.run("#<c>=4"), CapReached);
  EXPECT_EQ(machine.value_of("#<a>"), 3);
}

}  // namespace
}  // namespace kcs::gcode
