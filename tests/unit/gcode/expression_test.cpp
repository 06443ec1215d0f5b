// What an expression is worth, and what has no value.
#include "server/gcode/expression.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/unit/gcode/machine.h"
#include "tests/unit/gcode/program.h"

namespace kcs::gcode {
namespace {

double value_of(std::string_view text) { return Machine().value_of(text); }

struct Worth {
  const char* text;
  double value;
};

class Expressions : public testing::TestWithParam<Worth> {};

TEST_P(Expressions, AreWorth) { EXPECT_EQ(value_of(GetParam().text), GetParam().value) << GetParam().text; }

INSTANTIATE_TEST_SUITE_P(Operators, Expressions,
                         testing::Values(Worth{"[1+2]", 3}, Worth{"[1-2-3]", -4}, Worth{"[2*3]", 6},
                                         Worth{"[7/2]", 3.5}, Worth{"[24/4/3]", 2}, Worth{"[2**10]", 1024},
                                         Worth{"[3**2]", 9}, Worth{"[10**-3]", 0.001}, Worth{"[-2**3]", -8},
                                         Worth{"[0**0]", 1}, Worth{"[7 MOD 3]", 1}, Worth{"[-7 MOD 3]", 2},
                                         Worth{"[7 MOD -3]", 1}, Worth{"[-7 MOD -3]", 2}, Worth{"[5.5 MOD 2]", 1.5}));

INSTANTIATE_TEST_SUITE_P(Comparisons, Expressions,
                         testing::Values(Worth{"[1 EQ 1]", 1}, Worth{"[1 EQ 1.00009]", 1}, Worth{"[1 EQ 1.0002]", 0},
                                         Worth{"[1 NE 1.00009]", 0}, Worth{"[1 NE 2]", 1}, Worth{"[2 GT 1]", 1},
                                         Worth{"[1 GT 1]", 0}, Worth{"[1 GE 1]", 1}, Worth{"[1 GE 1.00005]", 0},
                                         Worth{"[1 LT 2]", 1}, Worth{"[1 LT 1]", 0}, Worth{"[1 LE 1]", 1},
                                         Worth{"[1 LE 0.99995]", 0}));

INSTANTIATE_TEST_SUITE_P(Logic, Expressions,
                         testing::Values(Worth{"[2 AND -3]", 1}, Worth{"[2 AND 0]", 0}, Worth{"[0 OR 0.5]", 1},
                                         Worth{"[0 OR 0]", 0}, Worth{"[1 XOR 2]", 0}, Worth{"[0 XOR 2]", 1}));

// Each would be worth something else with the operators in another order.
INSTANTIATE_TEST_SUITE_P(Precedence, Expressions,
                         testing::Values(Worth{"[2+3*4]", 14}, Worth{"[2*3**2]", 18}, Worth{"[2**3**2]", 64},
                                         Worth{"[-2**2]", 4}, Worth{"[2-3*4/5+1]", 2 - 12.0 / 5 + 1},
                                         Worth{"[12/2 MOD 4]", 2}, Worth{"[1+1 GT 1]", 1}, Worth{"[3 GT 1+1]", 1},
                                         Worth{"[2 LT 1 OR 1]", 1}, Worth{"[1 OR 0 AND 0]", 0},
                                         Worth{"[0 AND 0 OR 1]", 1}, Worth{"[1 OR 0 EQ 0]", 1},
                                         Worth{"[9+8*7/6+5-4*3**2+1]", 9 + 8 * 7.0 / 6 + 5 - 36 + 1}));

INSTANTIATE_TEST_SUITE_P(Functions, Expressions,
                         testing::Values(Worth{"ABS[-2.5]", 2.5}, Worth{"ABS[2.5]", 2.5}, Worth{"ACOS[-1]", 180},
                                         Worth{"ACOS[0]", 90}, Worth{"ASIN[-1]", -90}, Worth{"ATAN[1]/[1]", 45},
                                         Worth{"ATAN[1]/[-1]", 135}, Worth{"ATAN[-1]/[-1]", -135},
                                         Worth{"ATAN[0]/[-2]", 180}, Worth{"ATAN[2+1]/[0]", 90}, Worth{"COS[60]", 0.5},
                                         Worth{"COS[90]", 0}, Worth{"EXP[0]", 1}, Worth{"EXP[1]", 2.718281828459045},
                                         Worth{"FIX[2.8]", 2}, Worth{"FIX[-2.2]", -3}, Worth{"FUP[2.2]", 3},
                                         Worth{"FUP[-2.8]", -2}, Worth{"LN[1]", 0}, Worth{"LN[10]", 2.302585092994046},
                                         Worth{"ROUND[2.5]", 3}, Worth{"ROUND[-2.5]", -3}, Worth{"ROUND[2.4999]", 2},
                                         Worth{"SIN[30]", 0.5}, Worth{"SIN[-390]", -0.5},
                                         Worth{"SQRT[2]", 1.4142135623730951}, Worth{"TAN[45]", 1},
                                         Worth{"TAN[135]", -1}));

INSTANTIATE_TEST_SUITE_P(Forms, Expressions,
                         testing::Values(Worth{"2.5", 2.5}, Worth{"[ [ [ 3 ] ] ]", 3}, Worth{"-[1+2]", -3},
                                         Worth{"+[1+2]", 3}, Worth{"-SQRT[4]", -2}, Worth{"[2--1]", 3},
                                         Worth{"[2*-1]", -2}, Worth{"[-ABS[-1]]", -1}, Worth{"[- 2 + + 3]", 1},
                                         Worth{"sqrt[16]", 4}, Worth{"S q R\tt [ 1 6 ]", 4}, Worth{"[7mod4]", 3},
                                         Worth{"[1eq1]", 1}, Worth{"[2 * * 3]", 8}, Worth{"[SIN[30]*SIN[30]]", 0.25},
                                         Worth{"#1", 0}, Worth{"-#1", 0}, Worth{"EXISTS[#<x>]", 0}));

struct BadExpression {
  const char* line;
  int column;
  const char* reason;
};

class BadExpressions : public testing::TestWithParam<BadExpression> {};

TEST_P(BadExpressions, AreRefusedWithPlaceAndReason) {
  const std::string refusal = refusal_of("G21\n" + std::string(GetParam().line));
  EXPECT_TRUE(refusal.starts_with("gcode, line 2, column " + std::to_string(GetParam().column) + ": ")) << refusal;
  EXPECT_NE(refusal.find(GetParam().reason), std::string::npos) << refusal;
}

INSTANTIATE_TEST_SUITE_P(
    Values, BadExpressions,
    testing::Values(BadExpression{"X[1/0]", 4, "division by zero"}, BadExpression{"X[1 MOD [2-2]]", 5, "right of MOD"},
                    BadExpression{"X[0**-1]", 4, "division by zero"},
                    BadExpression{"X[[0-2]**0.5]", 8, "power that is not whole"},
                    BadExpression{"X[9**400]", 4, "too large"}, BadExpression{"X[-9**401]", 5, "too large"},
                    BadExpression{"X[1+EXP[710]]", 5, "too large"}, BadExpression{"XSQRT[-1]", 2, "square root"},
                    BadExpression{"X [1+LN[0]]", 6, "logarithm"}, BadExpression{"XACOS[1.1]", 2, "-1 to 1"},
                    BadExpression{"XASIN[-1.1]", 2, "-1 to 1"}, BadExpression{"XTAN[90]", 2, "right angle"},
                    BadExpression{"XTAN[-270]", 2, "right angle"}));

INSTANTIATE_TEST_SUITE_P(
    Forms, BadExpressions,
    testing::Values(BadExpression{"X[1+2", 2, "not closed"}, BadExpression{"X[1+2 Y3", 7, "an operator or ']'"},
                    BadExpression{"X[1 2 3 X]", 9, "an operator or ']'"}, BadExpression{"X[]", 3, "a value is missing"},
                    BadExpression{"X[1+]", 5, "a value is missing"}, BadExpression{"X[*2]", 3, "a value is missing"},
                    BadExpression{"X-Y", 3, "a value is missing"}, BadExpression{"X[1.5E2]", 3, "without exponent"},
                    BadExpression{"X[1.2.3]", 3, "is not a number"}, BadExpression{"X[--2]", 3, "is not a number"},
                    BadExpression{"XSIN30", 5, "SIN needs a value in brackets"},
                    BadExpression{"XATAN[1]", 9, "'/' is missing"}, BadExpression{"XATAN[1]/2", 10, "ATAN needs"},
                    BadExpression{"XEXISTS[1]", 8, "EXISTS[#<depth>]"}, BadExpression{"XEXISTS[#1+1]", 8, "EXISTS"},
                    BadExpression{"X[1+(two)2]", 5, "parentheses make comments"},
                    BadExpression{"X[1(one)]", 4, "parentheses make comments"},
                    BadExpression{"X[1+2;]", 6, "an operator or ']'"},
                    BadExpression{"X[1+\x01]", 5, "control character 1"}, BadExpression{"X1+2", 3, "in brackets"},
                    BadExpression{"X2*3", 3, "inside brackets"}, BadExpression{"X6/2", 3, "inside brackets"},
                    BadExpression{"[1+2]", 1, "without a letter"}, BadExpression{"X[1]]", 5, "']' without '['"}));

TEST(Expression, MayBeNestedAsDeepAsTheLimit) {
  const auto nested = [](int depth) { return std::string(depth, '[') + "7" + std::string(depth, ']'); };
  EXPECT_EQ(value_of(nested(kMaxDepth - 1)), 7);
  EXPECT_NE(refusal_of("X" + nested(kMaxDepth)).find("more than 50 deep"), std::string::npos);
}

TEST(Expression, OfAnyKindIsLimitedInDepth) {
  for (const char* opening : {"[", "[1+", "SIN[", "#", "#[", "-[", "-#", "ATAN[1]/[", "[1+2*3**"}) {
    std::string text = "X";
    for (int level = 0; level < 5000; ++level) text += opening;
    EXPECT_NE(refusal_of(text).find("more than 50 deep"), std::string::npos) << opening;
  }
}

TEST(Expression, MayBeAsLongAsItsLine) {
  std::string sum = "[0";
  for (int term = 0; term < 10'000; ++term) sum += "+1*1";
  EXPECT_EQ(value_of(sum + "]"), 10'000);
}

}  // namespace
}  // namespace kcs::gcode
