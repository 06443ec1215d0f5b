// if, elseif, else and endif.
#include <gtest/gtest.h>

#include "tests/unit/gcode/program.h"

namespace kcs::gcode {
namespace {

using Ends = std::vector<double>;

// The X of the moves that a condition on #1 leaves.
Ends chosen(const std::string& value) {
  return x_of(read_program("#1=" + value +
                           "\no1 if [#1 LT 0]\nG0 X-1\nX-2\no1 elseif [#1 EQ 0]\nG0 X10\no1 elseif [#1 LT 5]\n"
                           "G0 X20\no1 else\nG0 X30\no1 endif\nG0 X99"));
}

TEST(Conditions, RunTheFirstPartThatHolds) {
  EXPECT_EQ(chosen("-3"), (Ends{-1, -2, 99}));
  EXPECT_EQ(chosen("0"), (Ends{10, 99}));
  EXPECT_EQ(chosen("2"), (Ends{20, 99}));
  EXPECT_EQ(chosen("7"), (Ends{30, 99}));
}

TEST(Conditions, WithoutElseMayRunNothing) {
  EXPECT_EQ(x_of(read_program("o1 if [0]\nG0 X1\no1 elseif [0]\nG0 X2\no1 endif\nG0 X3")), (Ends{3}));
}

TEST(Conditions, TakeAllButZeroForTrue) {
  EXPECT_EQ(x_of(read_program("o1 if [0.00001]\nG0 X1\no1 endif")), (Ends{1}));
  EXPECT_EQ(x_of(read_program("o1 if [-1]\nG0 X1\no1 endif")), (Ends{1}));
}

TEST(Conditions, StandInsideOneAnother) {
  const Program program = read_program(
      "o1 if [1]\no2 if [0]\no3 if [1]\nG0 X1\no3 else\nG0 X2\no3 endif\no2 elseif [1]\nG0 X3\no2 endif\no1 else\n"
      "o4 if [1]\nG0 X4\no4 endif\no1 endif\nG0 X5");
  EXPECT_EQ(x_of(program), (Ends{3, 5}));
  EXPECT_EQ(lines_of(program), (std::vector<std::uint32_t>{9, 16}));
}

TEST(Conditions, ReadNothingThatIsSkipped) {
  EXPECT_EQ(x_of(read_program("o1 if [1]\nG0 X1\no1 elseif [#<nothing>]\nX[\no2 if [\no2 endif\no9 call\no1 endif")),
            (Ends{1}));
}

TEST(Conditions, MayUseALabelAgain) {
  EXPECT_EQ(x_of(read_program("o1 if [1]\nG0 X1\no1 endif\no1 if [0]\nG0 X2\no1 endif\no1 repeat [1]\nG0 X3\n"
                              "o1 endrepeat")),
            (Ends{1, 3}));
}

TEST(Conditions, KeepNoText) {
  Options options;
  options.max_kept_bytes = 200;
  std::string program = "o1 if [1]\n";
  for (int line = 1; line <= 1000; ++line) program += "G0 X" + std::to_string(line) + "\n";
  EXPECT_EQ(read_program(program + "o1 endif", options).segments().size(), 1000U);
}

TEST(Conditions, MayContainTheProgramsEnd) {
  EXPECT_EQ(x_of(read_program("G0 X1\no1 if [1]\nM2\no1 endif\nG0 X2")), (Ends{1}));
  EXPECT_EQ(x_of(read_program("G0 X1\no1 if [0]\nM2\no1 endif\nG0 X2")), (Ends{1, 2}));
}

struct BadCondition {
  const char* program;
  const char* refusal;
};

class BadConditions : public testing::TestWithParam<BadCondition> {};

TEST_P(BadConditions, AreRefusedWithPlaceAndReason) {
  const std::string refusal = refusal_of(GetParam().program);
  EXPECT_TRUE(refusal.starts_with(GetParam().refusal)) << refusal;
}

INSTANTIATE_TEST_SUITE_P(
    Conditions, BadConditions,
    testing::Values(
        BadCondition{"G21\n o1 endif", "gcode, line 2, column 2: o1 endif has no o1 if before it. Add that"},
        BadCondition{"o1 else", "gcode, line 1, column 1: o1 else has no o1 if before it."},
        BadCondition{"o1 elseif [1]", "gcode, line 1, column 1: o1 elseif has no o1 if before it."},
        BadCondition{"o1 if [1]\no2 endif",
                     "gcode, line 2, column 1: o2 endif has no o2 if before it: o1 if of line 1 is open here."},
        BadCondition{"o1 if [0]\no2 if [1]\no1 endif",
                     "gcode, line 3, column 1: o1 endif has no o1 if before it: o2 if of line 2 is open here."},
        BadCondition{"o1 if [1]\no1 else\no1 else", "gcode, line 3, column 1: o1 else comes after else."},
        BadCondition{"o1 if [0]\no1 else\no1 elseif [1]", "gcode, line 3, column 1: o1 elseif comes after else."},
        BadCondition{"o1 while [0]\no1 endif", "gcode, line 2, column 1: o1 endif has no o1 if before it: o1 while of"},
        BadCondition{"o1 if [1]\no1 if [1]", "gcode, line 2, column 1: o1 if stands inside o1 if of line 1."},
        BadCondition{"o1 do\no2 if [1]\no1 while [1]",
                     "gcode, line 3, column 1: o1 while stands inside o1 do of line 1. Close what is open in that"},
        BadCondition{"G21\no1 if [1]\nG0 X1", "gcode, line 2, column 1: o1 if is not closed before the program ends."},
        BadCondition{"%\no1 if [0]\n%\no1 endif", "gcode, line 2, column 1: o1 if is not closed before the program"},
        BadCondition{"o1 if [1/0]\no1 endif", "gcode, line 1, column 9: a division by zero"}));

TEST(Conditions, InsideOneAnotherHaveABound) {
  const auto nested = [](int depth) {
    std::string program;
    for (int i = 0; i < depth; ++i) program += "o" + std::to_string(i) + " if [1]\n";
    for (int i = depth - 1; i >= 0; --i) program += "o" + std::to_string(i) + " endif\n";
    return program;
  };
  EXPECT_EQ(refusal_of(nested(100)), "");
  EXPECT_TRUE(
      refusal_of(nested(101)).starts_with("gcode, line 101, column 1: conditions and loops stand more than 100"));
}

}  // namespace
}  // namespace kcs::gcode
