// while, do and repeat, break and continue.
#include <gtest/gtest.h>

#include "tests/unit/gcode/program.h"

namespace kcs::gcode {
namespace {

using Ends = std::vector<double>;

TEST(Loops, WhileRunsAsLongAsItsConditionHolds) {
  const Program program =
      read_program("#1=0\no1 while [#1 LT 3]\n#1=[#1+1]\nG0 X#1\no1 endwhile\nG0 X9\no1 while [0]\nG0 X8\no1 endwhile");
  EXPECT_EQ(x_of(program), (Ends{1, 2, 3, 9}));
  EXPECT_EQ(lines_of(program), (std::vector<std::uint32_t>{4, 4, 4, 6}));
}

TEST(Loops, DoRunsOnceBeforeItsConditionIsAsked) {
  EXPECT_EQ(x_of(read_program("o1 do\n#1=[#1+1]\nG0 X#1\no1 while [#1 LT 3]\nG0 X9")), (Ends{1, 2, 3, 9}));
  EXPECT_EQ(x_of(read_program("o1 do\nG0 X1\no1 while [0]\nG0 X9")), (Ends{1, 9}));
}

TEST(Loops, DoMayContainWhileWithAnotherLabel) {
  EXPECT_EQ(x_of(read_program("o1 do\n#1=[#1+1] #2=0\no2 while [#2 LT 2]\n#2=[#2+1]\nG0 X[#1*10+#2]\no2 endwhile\n"
                              "o1 while [#1 LT 2]")),
            (Ends{11, 12, 21, 22}));
}

TEST(Loops, RepeatCountsRoundsOnce) {
  EXPECT_EQ(x_of(read_program("#1=3\no1 repeat [#1]\n#1=[#1+1]\nG0 X#1\no1 endrepeat\nG0 X9")), (Ends{4, 5, 6, 9}));
  EXPECT_EQ(x_of(read_program("o1 repeat [0]\nG0 X1\no1 endrepeat\no2 repeat [-2]\nG0 X2\no2 endrepeat\nG0 X9")),
            (Ends{9}));
}

TEST(Loops, StandInsideOneAnother) {
  EXPECT_EQ(x_of(read_program("o1 repeat [2]\n#1=[#1+10]\no2 repeat [2]\n#1=[#1+1]\nG0 X#1\no2 endrepeat\n"
                              "o3 if [#1 GT 20]\nG0 X99\no3 endif\no1 endrepeat")),
            (Ends{11, 12, 23, 24, 99}));
}

TEST(Loops, BreakLeavesTheLoop) {
  EXPECT_EQ(x_of(read_program("o1 while [1]\n#1=[#1+1]\nG0 X#1\no2 if [#1 EQ 2]\no1 break\no2 else\nG0 Y#1\no2 endif\n"
                              "G0 Z#1\no1 endwhile\nG0 X9")),
            (Ends{1, 1, 1, 2, 9}));
  EXPECT_EQ(x_of(read_program("o1 do\n#1=[#1+1]\nG0 X#1\no2 if [#1 EQ 2]\no1 break\no2 endif\no1 while [1]\nG0 X9")),
            (Ends{1, 2, 9}));
  EXPECT_EQ(x_of(read_program("o1 repeat [5]\n#1=[#1+1]\nG0 X#1\no2 if [#1 EQ 2]\no1 break\no2 endif\no1 endrepeat\n"
                              "G0 X9")),
            (Ends{1, 2, 9}));
}

TEST(Loops, BreakMayLeaveSeveralAtOnce) {
  EXPECT_EQ(x_of(read_program("o1 while [1]\no2 repeat [5]\no3 do\nG0 X1\no1 break\nG0 X2\no3 while [1]\nG0 X3\n"
                              "o2 endrepeat\nG0 X4\no1 endwhile\nG0 X9")),
            (Ends{1, 9}));
}

TEST(Loops, ContinueGoesOnWithTheNextRound) {
  for (const char* loop : {"while [#1 LT 4]", "repeat [4]"}) {
    EXPECT_EQ(x_of(read_program("o1 " + std::string(loop) + "\n#1=[#1+1]\no2 if [#1 EQ 2]\no1 continue\no2 endif\n" +
                                "G0 X#1\no1 end" + std::string(loop).substr(0, std::string(loop).find(' ')))),
              (Ends{1, 3, 4}))
        << loop;
  }
  EXPECT_EQ(x_of(read_program("o1 do\n#1=[#1+1]\no2 if [#1 EQ 2]\no1 continue\no2 endif\nG0 X#1\no1 while [#1 LT 4]")),
            (Ends{1, 3, 4}));
}

TEST(Loops, ContinueOfAnOuterLoopLeavesTheInner) {
  EXPECT_EQ(x_of(read_program("o1 repeat [2]\n#1=[#1+1]\no2 while [1]\nG0 X#1\no1 continue\no2 endwhile\nG0 X99\n"
                              "o1 endrepeat")),
            (Ends{1, 2}));
}

TEST(Loops, InADeadPartDoNotRun) {
  EXPECT_EQ(x_of(read_program("o1 if [0]\no2 while [1]\nG0 X1\no2 endwhile\no3 do\no3 break\no3 while [1]\no4 repeat "
                              "[9]\nG0 X2\no4 continue\no4 endrepeat\no1 endif\nG0 X9")),
            (Ends{9}));
}

struct BadLoop {
  const char* program;
  const char* refusal;
};

class BadLoops : public testing::TestWithParam<BadLoop> {};

TEST_P(BadLoops, AreRefusedWithPlaceAndReason) {
  const std::string refusal = refusal_of(GetParam().program);
  EXPECT_TRUE(refusal.starts_with(GetParam().refusal)) << refusal;
}

INSTANTIATE_TEST_SUITE_P(
    Loops, BadLoops,
    testing::Values(
        BadLoop{"o1 endwhile", "gcode, line 1, column 1: o1 endwhile has no o1 while before it."},
        BadLoop{"o1 endrepeat", "gcode, line 1, column 1: o1 endrepeat has no o1 repeat before it."},
        BadLoop{"o1 repeat [1]\no1 endwhile", "gcode, line 2, column 1: o1 endwhile has no o1 while before it: o1 rep"},
        BadLoop{"o1 do\no1 endwhile", "gcode, line 2, column 1: o1 endwhile has no o1 while before it: o1 do of"},
        BadLoop{"o1 while [0]\no2 endwhile", "gcode, line 2, column 1: o2 endwhile has no o2 while before it: o1 whi"},
        BadLoop{"o1 break", "gcode, line 1, column 1: o1 break stands in no loop with its label."},
        BadLoop{"o1 do\no2 continue", "gcode, line 2, column 1: o2 continue stands in no loop with its label."},
        BadLoop{"o1 if [1]\no1 break", "gcode, line 2, column 1: o1 break stands in no loop with its label."},
        BadLoop{"o1 repeat [1.5]", "gcode, line 1, column 11: o1 repeat takes a whole number, not 1.5"},
        BadLoop{"o1 do\nG0 X1", "gcode, line 1, column 1: o1 do is not closed before the program ends. Add o1 while."},
        BadLoop{"o1 while [1]", "gcode, line 1, column 1: o1 while is not closed before the program ends. Add o1 end"},
        BadLoop{"o1 repeat [1]", "gcode, line 1, column 1: o1 repeat is not closed before the program ends. Add o1 "},
        BadLoop{"o1 repeat [2]\n#<a>=[#1+1]\no2 if [#1]\nG0 X#<b>\no2 endif\n#1=1\no1 endrepeat",
                "gcode, line 4, column 5: #<b> is not set"}));

}  // namespace
}  // namespace kcs::gcode
