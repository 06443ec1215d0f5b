// Canned cycles: the moves of each, what holds from hole to hole, what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/unit/gcode/program.h"

namespace kcs::gcode {
namespace {

using planning::Segment;
using planning::Vector;

// The heights at which the moves end, rounded to 1e-9 mm.
std::vector<double> z_of(const Program& program) {
  std::vector<double> ends;
  for (const Segment& segment : program.segments()) ends.push_back(std::round(segment.end.z() * 1e9) / 1e9);
  return ends;
}

Program drilled(const std::string& lines, const Options& options = {}) {
  return read_program("G0 Z5\nF60\n" + lines, options);
}

using Heights = std::vector<double>;

TEST(Cycles, G81FeedsToTheBottomAndComesBackAtTheRapid) {
  const Program program = drilled("G81 X1 Y2 Z-1 R1");
  EXPECT_EQ(z_of(program), (Heights{5, 5, 1, -1, 1}));
  EXPECT_EQ(program.segments()[1].end, Vector(1, 2, 5));
  EXPECT_EQ(program.segments()[3].feed, 1);
  for (const int rapid : {1, 2, 4}) {
    EXPECT_EQ(program.segments().at(rapid).feed, std::numeric_limits<double>::infinity());
  }
}

TEST(Cycles, AreFollowedExactlyWhateverTheTolerance) {
  std::vector<bool> stops;
  const Program program = drilled("G64 P1\nG81 X1 Y2 Z-1 R1\nX2");
  for (const Segment& segment : program.segments()) stops.push_back(segment.stop);
  stops.pop_back();  // where the program ends
  EXPECT_EQ(stops, (std::vector<bool>{true, true, false, true, true, true, true}));
}

TEST(Cycles, G82DwellsAtTheBottom) {
  const Program program = drilled("G82 X1 Z-1 R1 P0.5");
  EXPECT_EQ(z_of(program), (Heights{5, 5, 1, -1, 1}));
  EXPECT_EQ(program.segments()[3].dwell, 0.5);
}

TEST(Cycles, G83LeavesTheHoleAfterEachPeck) {
  EXPECT_EQ(z_of(drilled("G83 X1 Z-2 R1 Q1.25")), (Heights{5, 5, 1, -0.25, 1, 0.004, -1.5, 1, -1.246, -2, 1}));
}

TEST(Cycles, G73OnlyBreaksTheChips) {
  EXPECT_EQ(z_of(drilled("G73 X1 Z-2 R1 Q1.25")), (Heights{5, 5, 1, -0.25, 0.004, -1.5, -1.246, -2, 1}));
}

TEST(Cycles, PecksThatFitExactlyLeaveNoRest) {
  EXPECT_EQ(z_of(drilled("G73 X1 Z0.4 R1 Q0.1")).size(), 3U + 5 * 2 + 1 + 1);
}

TEST(Cycles, G85AndG89ComeBackAtTheFeed) {
  EXPECT_EQ(drilled("G85 X1 Z-1 R1").segments().back().feed, 1);
  const Program program = drilled("G98 G89 X1 Z-1 R1 P2");
  EXPECT_EQ(program.segments()[3].dwell, 2);
  EXPECT_EQ(program.segments().back().feed, 1);
  EXPECT_EQ(z_of(program).back(), 5);
}

TEST(Cycles, G86DwellsAndComesBackAtTheRapid) {
  const Program program = drilled("G86 X1 Z-1 R1 P2");
  EXPECT_EQ(program.segments()[3].dwell, 2);
  EXPECT_EQ(program.segments().back().feed, std::numeric_limits<double>::infinity());
}

TEST(Cycles, HoldFromBlockToBlockUntilAnotherMotion) {
  const Program program = drilled("G81 X1 Z-1 R1\nX2\n(none)\nM8\nG4 P1\nX3 Z-2\nG80\nG0 X4");
  EXPECT_EQ(z_of(program), (Heights{5, 5, 1, -1, 1, 1, -1, 1, 1, -2, 1, 1}));
  EXPECT_EQ(program.end().x(), 4);
  EXPECT_NE(refusal_of("F60\nG81 X1 Z-1 R1\nG80\nX2").find("no motion is in force"), std::string::npos);
  EXPECT_NE(refusal_of("F60\nG81 X1 Z-1 R1\nG0 X2\nG81 X3 Z-1").find("G81 needs R"), std::string::npos);
  EXPECT_NE(refusal_of("F60\nG81 X1 Z-1 R1\nG82 X3 R1 P1").find("G82 needs the depth of its hole: Z"),
            std::string::npos);
}

TEST(Cycles, G98ComesBackToWhereTheSeriesBegan) {
  EXPECT_EQ(z_of(drilled("G98 G81 X1 Z-1 R1\nX2")), (Heights{5, 5, 1, -1, 5, 5, 1, -1, 5}));
  EXPECT_EQ(z_of(drilled("G99 G81 X1 Z-1 R1\nG98 X2")), (Heights{5, 5, 1, -1, 1, 5, 1, -1, 5}));
}

TEST(Cycles, BeginAtRWhereTheToolIsBelow) {
  EXPECT_EQ(z_of(read_program("F60\nG98 G81 X1 Z-1 R1")), (Heights{1, 1, -1, 1}));
}

TEST(Cycles, RepeatWithIncrements) {
  const Program program = drilled("G91 G81 X1 Y-1 Z-2 R-4 L3");
  EXPECT_EQ(z_of(program), (Heights{5, 5, 1, -1, 1, 1, -1, 1, 1, -1, 1}));
  EXPECT_EQ(program.end(), Vector(3, -3, 1));
}

TEST(Cycles, RepeatInPlaceWithoutIncrements) {
  EXPECT_EQ(z_of(drilled("G81 X1 Z-1 R1 L2")), (Heights{5, 5, 1, -1, 1, -1, 1}));
}

TEST(Cycles, DrillAlongTheAxisNormalToThePlane) {
  const Program program = read_program("G0 Y5\nF60\nG18 G81 X1 Z2 Y-1 R1");
  EXPECT_EQ(program.segments()[1].end, Vector(1, 5, 2));
  EXPECT_EQ(program.segments()[3].end, Vector(1, -1, 2));
}

TEST(Cycles, AreTurnedWithTheWorkOffset) {
  const Program program = drilled("G10 L2 P1 X10 R90\nG81 X1 Y0 Z-1 R1");
  EXPECT_NEAR((program.end() - Vector(10, 1, 1)).norm(), 0, 1e-12);
}

TEST(Cycles, KeepTheLineOfTheirBlock) {
  EXPECT_EQ(lines_of(drilled("G81 X1 Z-1 R1\nX2")), (std::vector<std::uint32_t>{1, 3, 3, 3, 3, 4, 4, 4}));
}

class RefusedCycles : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(RefusedCycles, SayWhatIsMissing) {
  const auto [block, reason] = GetParam();
  const std::string refusal = refusal_of("G0 Z5\nF60\n" + std::string(block));
  EXPECT_NE(refusal.find("line 3"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find(reason), std::string::npos) << refusal;
}

INSTANTIATE_TEST_SUITE_P(Cycles, RefusedCycles,
                         testing::Values(std::pair{"G81 X1 R1", "needs the depth"}, std::pair{"G81 X1 Z1", "needs R"},
                                         std::pair{"G81 Z-1 R-2 X1", "must lie below R"},
                                         std::pair{"G81 Z1 R1 X1", "must lie below R"},
                                         std::pair{"G82 X1 Z-1 R1", "needs its dwell: P"},
                                         std::pair{"G82 X1 Z-1 R1 P-1", "a dwell below zero"},
                                         std::pair{"G83 X1 Z-1 R1", "needs the depth of each peck: Q"},
                                         std::pair{"G83 X1 Z-1 R1 Q0.0001", "at least 0.001 mm"},
                                         std::pair{"G81 X1 Z-1 R1 L0", "a whole number from 1"},
                                         std::pair{"G81", "without X, Y or Z"},
                                         std::pair{"G53 G81 X1 Z-1 R1", "G53 goes with G0"},
                                         std::pair{"G93 G81 X1 Z-1 R1 F1", "canned cycles need a feed in mm/min"},
                                         std::pair{"G81 X1 Z-1 R1 I2", "a word without use"}));

TEST(Cycles, NeedAFeed) { EXPECT_NE(refusal_of("G81 X1 Z-1 R1").find("no feed is set"), std::string::npos); }

}  // namespace
}  // namespace kcs::gcode
