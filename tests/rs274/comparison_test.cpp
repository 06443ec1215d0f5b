// The comparison itself: what it must find.
#include "tests/rs274/comparison.h"

#include <gtest/gtest.h>

#include "tests/unit/gcode/program.h"

namespace kcs::test {
namespace {

using planning::Vector;

constexpr const char* kProgram = "F60\nG1 X10\nG4 P1\nG2 X12 I1 P2 Z3\n";

std::vector<Move> moves() {
  return {{.line = 2, .end = {10, 0, 0}},
          {.line = 4, .end = {12, 0, 3}, .turns = -2, .centre = {11, 0, 0}, .normal = 2}};
}

std::string difference_from(const std::vector<Move>& reference) {
  return difference(gcode::read_program(kProgram).path, reference);
}

TEST(Comparison, FindsNoneWherePathAndMovesAreTheSame) { EXPECT_EQ(difference_from(moves()), ""); }

TEST(Comparison, FindsWhatIsDifferent) {
  const Vector little(0, 2e-6, 0);
  auto other_end = moves();
  other_end[0].end += little;
  EXPECT_NE(difference_from(other_end), "");
  auto other_centre = moves();
  other_centre[1].centre += little;
  EXPECT_NE(difference_from(other_centre), "");
  auto other_turns = moves();
  other_turns[1].turns = -1;
  EXPECT_NE(difference_from(other_turns), "");
  auto other_way = moves();
  other_way[1].turns = 2;
  EXPECT_NE(difference_from(other_way), "");
  auto other_line = moves();
  other_line[1].line = 3;
  EXPECT_NE(difference_from(other_line), "");
  auto fewer = moves();
  fewer.pop_back();
  EXPECT_NE(difference_from(fewer), "");
  auto more = moves();
  more.push_back({.line = 5, .end = {0, 0, 0}});
  EXPECT_NE(difference_from(more), "");
}

}  // namespace
}  // namespace kcs::test
