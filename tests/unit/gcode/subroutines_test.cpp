// sub, endsub, call and return.
#include <gtest/gtest.h>

#include "tests/unit/gcode/program.h"

namespace kcs::gcode {
namespace {

using Ends = std::vector<double>;

TEST(Subroutines, RunWhereTheyAreCalledOnly) {
  const Program program = read_program("o1 sub\nG0 X1\nG0 X2\no1 endsub\nG0 X3\no1 call\no<1>call\nG0 X4");
  EXPECT_EQ(x_of(program), (Ends{3, 1, 2, 1, 2, 4}));
  EXPECT_EQ(lines_of(program), (std::vector<std::uint32_t>{5, 2, 3, 2, 3, 8}));
}

TEST(Subroutines, GetTheirArgumentsAsNumberedParameters) {
  EXPECT_EQ(x_of(read_program("o1 sub\nG0 X#1\nX#2\nX[#3+7]\no1 endsub\n#3=5\no1 call [1] [#3*2]")), (Ends{1, 10, 7}));
  std::string call = "o1 sub\nG0 X#30\no1 endsub\no1 call";
  for (int i = 1; i <= 30; ++i) call += " [" + std::to_string(i) + "]";
  EXPECT_EQ(x_of(read_program(call)), (Ends{30}));
  EXPECT_NE(refusal_of(call + "[31]").find("gcode, line 4, column 1: o1 call has more than 30 values"),
            std::string::npos);
}

TEST(Subroutines, HaveNumberedParametersUpTo30OfTheirOwn) {
  EXPECT_EQ(x_of(read_program("o1 sub\n#1=7 #30=8 #31=9\no1 endsub\n#1=1 #30=2 #31=3\no1 call [5]\n"
                              "G0 X#1\nX#30\nX#31")),
            (Ends{1, 2, 9}));
}

TEST(Subroutines, HaveNamesOfTheirOwn) {
  EXPECT_EQ(x_of(read_program("o1 sub\n#<a>=7 #<_depth>=8\no1 endsub\n#<a>=1\no1 call\nG0 X#<a>\nX#<_depth>")),
            (Ends{1, 8}));
  EXPECT_EQ(x_of(read_program("o1 sub\nG0 X[EXISTS[#<a>]+5]\n#<a>=1\nX[EXISTS[#<a>]+5]\no1 endsub\n#<a>=2\no1 call\n"
                              "o1 call")),
            (Ends{5, 6, 5, 6}));
  const std::string refusal = refusal_of("o1 sub\nG0 X#<a>\no1 endsub\n#<a>=1\no1 call");
  EXPECT_TRUE(refusal.starts_with("gcode, line 2, column 5: #<a> is not set in this call")) << refusal;
}

TEST(Subroutines, CallThemselves) {
  EXPECT_EQ(x_of(read_program("o1 sub\no2 if [#1 GT 0]\nG0 X#1\no1 call [#1-1]\nG0 X[10+#1]\no2 endif\no1 endsub\n"
                              "o1 call [3]")),
            (Ends{3, 2, 1, 11, 12, 13}));
}

TEST(Subroutines, CallOthersThatAreDefinedLater) {
  EXPECT_EQ(x_of(read_program("o1 sub\no2 call [#1+1]\no1 endsub\no2 sub\nG0 X#1\no2 endsub\no1 call [1]")), (Ends{2}));
}

TEST(Subroutines, HaveLabelsOfTheirOwn) {
  EXPECT_EQ(x_of(read_program("o1 sub\no5 repeat [2]\n#31=[#31+1]\nG0 X#31\no5 endrepeat\no1 endsub\n"
                              "o5 repeat [2]\no1 call\no5 endrepeat")),
            (Ends{1, 2, 3, 4}));
}

TEST(Subroutines, ReturnFromInsideConditionsAndLoops) {
  const std::string sub =
      "o1 sub\no2 while [1]\nG0 X#1\no3 if [#1 GE 2]\no1 return\no3 endif\n#1=[#1+1]\no2 endwhile\n"
      "o1 endsub\n";
  EXPECT_EQ(x_of(read_program(sub + "o1 call [1]\nG0 X9\no1 call [1]")), (Ends{1, 2, 9, 1, 2}));
}

TEST(Subroutines, ReturnWithTheLabelOfAnythingTheyStandIn) {
  EXPECT_EQ(x_of(read_program("o1 sub\no2 if [1]\no2 return\no2 endif\nG0 X1\no1 endsub\no1 call\nG0 X2")), (Ends{2}));
}

TEST(Subroutines, ReturnValues) {
  const std::string both = "G0 X[10*#<_value_returned>+#<_value>]\n";
  EXPECT_EQ(x_of(read_program("o1 sub\no2 if [#1]\no1 return [#1*2]\no2 endif\no1 endsub\no3 sub\no3 endsub [7]\n"
                              "G0 X99\n" +
                              both + "o1 call [3]\n" + both + "o3 call\n" + both + "o1 call [0]\n" + both)),
            (Ends{99, 0, 16, 17, 0}));
}

TEST(Subroutines, KnowHowManyCallsAreRunning) {
  EXPECT_EQ(x_of(read_program("o1 sub\nG0 X[#<_call_level>]\no2 if [#1]\no1 call\no2 endif\no1 endsub\no1 call [1]\n"
                              "G0 X#<_call_level>")),
            (Ends{1, 2, 0}));
}

TEST(Subroutines, MayEndTheProgram) {
  EXPECT_EQ(x_of(read_program("o1 sub\nG0 X1\nM2\nG0 X2\no1 endsub\no1 call\nG0 X3")), (Ends{1}));
}

TEST(Subroutines, LeaveModesInForce) {
  EXPECT_EQ(x_of(read_program("o1 sub\nG91\no1 endsub\nG0 X1\no1 call\nX1")), (Ends{1, 2}));
}

TEST(Subroutines, MayBeAllThatAProgramHas) { EXPECT_EQ(refusal_of("o1 sub\nG0 X1\no1 endsub\nM2"), ""); }

struct BadSubroutine {
  const char* program;
  const char* refusal;
};

class BadSubroutines : public testing::TestWithParam<BadSubroutine> {};

TEST_P(BadSubroutines, AreRefusedWithPlaceAndReason) {
  const std::string refusal = refusal_of(GetParam().program);
  EXPECT_TRUE(refusal.starts_with(GetParam().refusal)) << refusal;
}

INSTANTIATE_TEST_SUITE_P(
    Subroutines, BadSubroutines,
    testing::Values(
        BadSubroutine{"o<bore> call",
                      "gcode, line 1, column 1: o<bore> is not defined before this call. Put o<bore> "
                      "sub, its lines and o<bore> endsub before it; a subroutine that lies in another "
                      "file must be copied into the program."},
        BadSubroutine{"o1 call\nM2\no1 sub\no1 endsub", "gcode, line 1, column 1: o1 is not defined before this call."},
        BadSubroutine{"o1 sub\no1 endsub\no1 sub\no1 endsub",
                      "gcode, line 3, column 1: o1 is defined already, in line 1"},
        BadSubroutine{"o1 sub\no2 sub", "gcode, line 2, column 1: o2 sub stands inside o1 sub of line 1."},
        BadSubroutine{"o1 if [1]\no2 sub", "gcode, line 2, column 1: o2 sub stands inside o1 if of line 1."},
        BadSubroutine{"o1 sub\no2 endsub", "gcode, line 2, column 1: o2 endsub has no o2 sub before it: o1 sub of"},
        BadSubroutine{"o1 endsub", "gcode, line 1, column 1: o1 endsub has no o1 sub before it."},
        BadSubroutine{"o1 sub\no2 if [1]\no1 endsub", "gcode, line 3, column 1: o1 endsub has no o1 sub before it: o2"},
        BadSubroutine{"o1 sub\no2 endif\no1 endsub", "gcode, line 2, column 1: o2 endif has no o2 if before it: o1 su"},
        BadSubroutine{"o1 return", "gcode, line 1, column 1: o1 return stands outside of every subroutine."},
        BadSubroutine{"o1 sub\nG0 X1",
                      "gcode, line 1, column 1: o1 sub is not closed before the program ends. Add o1 "
                      "endsub."},
        BadSubroutine{"o1 sub\no1 return [1] [2]\no1 endsub\no1 call",
                      "gcode, line 2, column 15: this does not belong"},
        BadSubroutine{"#<_value>=1", "gcode, line 1, column 1: #<_value> is the machine's"},
        BadSubroutine{"#<_call_level>=1", "gcode, line 1, column 1: #<_call_level> is the machine's"}));

TEST(Subroutines, SayInARefusalWhereTheyWereCalled) {
  const std::string once = refusal_of("o<bore> sub\nG1 X1 F0.0000000001\no<bore> endsub\nG0 X1\no<bore> call [1]");
  EXPECT_TRUE(once.starts_with("gcode, line 2, column 7: a feed of ")) << once;
  EXPECT_TRUE(once.ends_with(" This is in o<bore>, called from line 5.")) << once;
  const std::string twice = refusal_of("o1 sub\nX[\no1 endsub\no2 sub\no1 call\no2 endsub\no2 call");
  EXPECT_TRUE(twice.starts_with("gcode, line 2, column ")) << twice;
  EXPECT_TRUE(twice.ends_with(" This is in o1, called from line 5, and the main program is at its call in line 7."))
      << twice;
  EXPECT_EQ(refusal_of("o1 sub\nG0 X1\no1 endsub\no1 call\nX[").find("called from"), std::string::npos);
}

TEST(Subroutines, CallOneAnotherToABound) {
  const std::string sub = "o1 sub\no2 if [#1 GT 1]\no1 call [#1-1]\no2 endif\nG0 X#1\no1 endsub\n";
  EXPECT_EQ(read_program(sub + "o1 call [100]").segments().size(), 100U);
  const std::string refusal = refusal_of(sub + "o1 call [101]");
  EXPECT_TRUE(refusal.starts_with("gcode, line 3, column 1: more than 100 calls run inside one another.")) << refusal;
}

}  // namespace
}  // namespace kcs::gcode
