#include "client/cli/operator_keys.h"

#include <gtest/gtest.h>

namespace kcs::cli {
namespace {

TEST(OperatorKeys, AreOrdersAtOnceButForAbort) {
  OperatorKeys keys;
  EXPECT_EQ(keys.press('h'), Order::kHold);
  EXPECT_EQ(keys.press('r'), Order::kResume);
  EXPECT_EQ(keys.press('-'), Order::kSlower);
  EXPECT_EQ(keys.press('+'), Order::kFaster);
  EXPECT_EQ(keys.press('='), Order::kFaster) << "+ without shift";
  EXPECT_EQ(keys.press('q'), Order::kLeave);
  EXPECT_EQ(keys.press('y'), std::nullopt) << "nothing was asked";
  EXPECT_EQ(keys.press('x'), std::nullopt);
}

TEST(OperatorKeys, AbortOnlyAfterAYes) {
  OperatorKeys keys;
  const std::string legend = keys.legend();
  EXPECT_EQ(keys.press('a'), std::nullopt);
  EXPECT_NE(keys.legend().find("y / n"), std::string::npos) << keys.legend();
  EXPECT_EQ(keys.press('y'), Order::kAbort);
  EXPECT_EQ(keys.legend(), legend);
  for (const char no : {'n', 'a', 'q', 'r', '+'}) {
    keys.press('a');
    EXPECT_EQ(keys.press(no), std::nullopt) << no;
    EXPECT_EQ(keys.legend(), legend) << no;
  }
  EXPECT_EQ(keys.press('y'), std::nullopt) << "the question is answered";
}

TEST(OperatorKeys, HoldNeverWaitsForAnAnswer) {
  OperatorKeys keys;
  keys.press('a');
  EXPECT_EQ(keys.press('h'), Order::kHold);
  EXPECT_EQ(keys.press('y'), std::nullopt);
}

}  // namespace
}  // namespace kcs::cli
