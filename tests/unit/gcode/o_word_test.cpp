// O words as they are written.
#include "server/gcode/o_word.h"

#include <gtest/gtest.h>

#include "tests/unit/gcode/program.h"

namespace kcs::gcode {
namespace {

OWord o_word_of(std::string_view line) {
  Cursor cursor(line, 7);
  return read_o_word(cursor);
}

TEST(OWords, HaveNumbersOrNames) {
  EXPECT_EQ(o_word_of("o100 sub").label, "100");
  EXPECT_EQ(o_word_of("O 01 00sub").label, "100");
  EXPECT_EQ(o_word_of("o0 sub").label, "0");
  EXPECT_EQ(o_word_of("o<Slot One> sub").label, "slotone");
  EXPECT_EQ(o_word_of("o<100> sub").label, "100");
}

TEST(OWords, HaveKeywordsOfAnyCaseAndSpacing) {
  EXPECT_EQ(o_word_of("o1if[1]").keyword, Keyword::kIf);
  EXPECT_EQ(o_word_of("o1 ELSEIF [1]").keyword, Keyword::kElseIf);
  EXPECT_EQ(o_word_of("o1 Else").keyword, Keyword::kElse);
  EXPECT_EQ(o_word_of("o1 endif").keyword, Keyword::kEndIf);
  EXPECT_EQ(o_word_of("o1\twhi le [1]").keyword, Keyword::kWhile);
  EXPECT_EQ(o_word_of("o1 endwhile").keyword, Keyword::kEndWhile);
  EXPECT_EQ(o_word_of("o1do").keyword, Keyword::kDo);
  EXPECT_EQ(o_word_of("o1 repeat [2]").keyword, Keyword::kRepeat);
  EXPECT_EQ(o_word_of("o1 endrepeat").keyword, Keyword::kEndRepeat);
  EXPECT_EQ(o_word_of("o1 break").keyword, Keyword::kBreak);
  EXPECT_EQ(o_word_of("o1 continue").keyword, Keyword::kContinue);
  EXPECT_EQ(o_word_of("o1 call [1]").keyword, Keyword::kCall);
  EXPECT_EQ(o_word_of("o1 return [1]").keyword, Keyword::kReturn);
  EXPECT_EQ(o_word_of("o1 sub").keyword, Keyword::kSub);
  EXPECT_EQ(o_word_of("o1 endsub").keyword, Keyword::kEndSub);
  EXPECT_EQ(o_word_of("o1 (title)").keyword, Keyword::kNone);
}

TEST(OWords, StandBehindNothingButALineNumber) {
  EXPECT_TRUE(begins_with_o_word("o1 sub"));
  EXPECT_TRUE(begins_with_o_word(" \tO1 sub"));
  EXPECT_TRUE(begins_with_o_word(" n10 o1 sub"));
  EXPECT_TRUE(begins_with_o_word("N1 0.5O1 sub"));
  EXPECT_FALSE(begins_with_o_word("G1 O1 sub"));
  EXPECT_FALSE(begins_with_o_word("N10 G1"));
  EXPECT_FALSE(begins_with_o_word("N10"));
  EXPECT_FALSE(begins_with_o_word("(o1 sub)"));
  EXPECT_FALSE(begins_with_o_word(""));
  EXPECT_EQ(o_word_of("N10 o2 sub").label, "2");
  EXPECT_EQ(o_word_of("N10 o2 sub").place.column, 5U);
}

TEST(OWords, SayHowTheyAreWritten) {
  EXPECT_EQ(o_word_of("O007 WHILE [1]").text(), "o7 while");
  EXPECT_EQ(o_word_of("O<A b> sub").text(Keyword::kEndSub), "o<ab> endsub");
  EXPECT_EQ(o_word_of("O0007").text(), "o7");
}

struct BadOWord {
  const char* line;
  int column;
  const char* reason;
};

class BadOWords : public testing::TestWithParam<BadOWord> {};

TEST_P(BadOWords, AreRefusedWithPlaceAndReason) {
  const std::string refusal = refusal_of("o1 sub\no1 endsub\nG21\n" + std::string(GetParam().line));
  EXPECT_TRUE(refusal.starts_with("gcode, line 4, column " + std::to_string(GetParam().column) + ": ")) << refusal;
  EXPECT_NE(refusal.find(GetParam().reason), std::string::npos) << refusal;
}

INSTANTIATE_TEST_SUITE_P(
    OWords, BadOWords,
    testing::Values(
        BadOWord{"o sub", 2, "a number (o100) or a name"}, BadOWord{"o", 2, "a number (o100) or a name"},
        BadOWord{"o[1] call", 2, "cannot be computed"}, BadOWord{"o#1 call", 2, "cannot be computed"},
        BadOWord{"o-1 sub", 2, "a number (o100) or a name"}, BadOWord{"o1234567890 sub", 2, "more than 9 digits"},
        BadOWord{"o<> sub", 3, "name is missing"}, BadOWord{"o<a sub", 3, "not closed"},
        BadOWord{"o1 goto", 4, "goes on with sub"}, BadOWord{"o1 X1", 4, "goes on with sub"},
        BadOWord{"o1\x01", 3, "goes on with sub"}, BadOWord{"o1", 1, "a program number"},
        BadOWord{"o1 (title", 4, "comment is not closed"}, BadOWord{"o2 if 1", 7, "needs a value in brackets"},
        BadOWord{"o2 if", 6, "needs a value in brackets"}, BadOWord{"o2 while", 9, "needs a value in brackets"},
        BadOWord{"o2 repeat", 10, "needs a value in brackets"}, BadOWord{"o2 if [1", 7, "not closed"},
        BadOWord{"o2 if [#<x>]", 8, "#<x> is not set"}, BadOWord{"o2 if [1] [2]", 11, "takes one value"},
        BadOWord{"o2 if [1] G1", 11, "line of its own"}, BadOWord{"o2 do [1]", 7, "takes no value"},
        BadOWord{"o2 sub [1]", 8, "takes no value"}, BadOWord{"o1 call 1", 9, "takes values in brackets"},
        BadOWord{"o1 call [1] #2", 13, "takes values in brackets"}, BadOWord{"o1 callsub", 8, "takes values in"},
        BadOWord{"o1 call \x02", 9, "control character"}, BadOWord{"o1 call [1] (c", 13, "comment is not closed"}));

TEST(OWords, MayHaveCommentsBehindThem) {
  EXPECT_EQ(
      refusal_of("o1 sub (c) ; d\no1 endsub (c)\no1 call (a) [1] (b) [2] ; c\no2 if [1] (c)\no2 else ;c\no2 endif"),
      "");
}

}  // namespace
}  // namespace kcs::gcode
