// Where the tool rests: path control, dwells, stops of the program.
#include <gtest/gtest.h>

#include <vector>

#include "server/gcode/path_builder.h"
#include "tests/unit/gcode/program.h"

namespace kcs::gcode {
namespace {

std::vector<std::size_t> stops_of(const Program& program) {
  std::vector<std::size_t> stops;
  for (std::size_t i = 0; i < program.segments().size(); ++i) {
    if (program.segments()[i].stop) stops.push_back(i);
  }
  return stops;
}

using Stops = std::vector<std::size_t>;

TEST(PathControl, BlendsWithTheToleranceOfTheOptionsUntilG64SaysOtherwise) {
  Options options;
  options.tolerance = 0.05;
  const Program program = read_program("G0 X1\nG64 P.2 X2 Y1\nG64 X3\nG20 G64 P.001 X4", options);
  const double tolerances[] = {0.05, 0.2, 0.05, 0.0254};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(program.segments()[i].tolerance, tolerances[i]);
  EXPECT_EQ(stops_of(program), Stops{});
}

TEST(PathControl, RefusesToleranceOutOfRange) {
  EXPECT_NE(refusal_of("G64 P-1").find("column 5"), std::string::npos);
  EXPECT_NE(refusal_of("G64 P1001"), "");
}

TEST(PathControl, ExactPathRestsAtCornersAndNowhereElse) {
  EXPECT_EQ(stops_of(read_program("G61 G0 X1\nX2\nX3 Y1\nX4 Y2\nX3 Y1")), (Stops{1, 3}));
  EXPECT_EQ(stops_of(read_program("G64 P0\nG0 X1\nX2 Y1")), Stops{0});
}

TEST(PathControl, ZeroToleranceOfTheOptionsActsLikeExactPath) {
  Options options;
  options.tolerance = 0;
  EXPECT_EQ(stops_of(read_program("G0 X1\nX2\nX3 Y1\nG64\nX4", options)), (Stops{1, 2}));
}

TEST(PathControl, ExactPathHoldsAtBothEndsOfItsMoves) {
  EXPECT_EQ(stops_of(read_program("G0 X1\nY1\nG61 X2\nG64 Y2\nX3")), (Stops{1, 2}));
}

TEST(PathControl, ExactPathRunsThroughArcsAndTangentsToThem) {
  // A slot: line, half circle, line, half circle, then a corner.
  const Program slot = read_program("G61 F600 G1 X10\nG3 Y10 J5\nG1 X0\nG3 Y0 J-5\nG1 X5 Y5");
  const Stops stops = stops_of(slot);
  ASSERT_EQ(stops.size(), 1U);
  EXPECT_EQ(stops[0], slot.segments().size() - 2);
  for (const planning::Segment& segment : slot.segments()) EXPECT_EQ(segment.tolerance, kExactTolerance);
  EXPECT_LE(slot.chord_error, kExactTolerance);
}

TEST(PathControl, ExactPathRestsBetweenArcsThatMeetAtACorner) {
  const Program program = read_program("G61 F600 G3 X10 R5\nG3 X20 R5");
  EXPECT_EQ(stops_of(program), Stops{program.segments().size() / 2 - 1});
}

TEST(PathControl, ExactStopRestsAfterEveryMoveButNotOnChords) {
  const Program program = read_program("G61.1 F600 G1 X1\nX2\nG2 I5");
  EXPECT_EQ(stops_of(program), (Stops{0, 1, program.segments().size() - 1}));
}

TEST(Dwell, StaysWhereTheToolIs) {
  const Program program = read_program("G0 X1\nG4 P.5\nG4 P1\nX2");
  ASSERT_EQ(program.segments().size(), 2U);
  EXPECT_EQ(program.segments()[0].dwell, 1.5);
  EXPECT_EQ(stops_of(program), Stops{0});
}

TEST(Dwell, OfNoTimeIsAnExactStop) { EXPECT_EQ(stops_of(read_program("G0 X1\nG4 P0\nX2")), Stops{0}); }

TEST(Dwell, BeforeTheFirstMoveHasASegmentOfNoLength) {
  Options options;
  options.start = {1, 2, 3};
  const Program program = read_program("\nG4 P2\nG0 X5", options);
  ASSERT_EQ(program.segments().size(), 2U);
  EXPECT_EQ(program.segments()[0].end, options.start);
  EXPECT_EQ(program.segments()[0].dwell, 2);
  EXPECT_EQ(program.segments()[0].line, 2U);
  EXPECT_GT(program.segments()[0].feed, 0);
  EXPECT_TRUE(program.segments()[0].stop);
}

TEST(Dwell, ComesBeforeTheMoveOfItsBlock) {
  const Program program = read_program("G0 X1\nG4 P1 G0 X2");
  EXPECT_EQ(program.segments()[0].dwell, 1);
  EXPECT_EQ(program.segments()[1].dwell, 0);
}

TEST(Dwell, NeedsATimeInP) {
  EXPECT_NE(refusal_of("G4").find("P in seconds"), std::string::npos);
  EXPECT_NE(refusal_of("G4 S5").find("P in seconds"), std::string::npos);
  EXPECT_NE(refusal_of("G0 X0\nG4 P1 X2").find("line 2, column 7: an axis word"), std::string::npos);
  EXPECT_NE(refusal_of("G4 P-1").find("column 4"), std::string::npos);
  EXPECT_NE(refusal_of("G4 P1000000\nG4 P1").find("line 2"), std::string::npos);
}

TEST(Stop, IsWhereTheProgramStopsOrChangesTheTool) {
  for (const char* stop : {"M0", "M1", "M60", "M6 T2", "M06"}) {
    EXPECT_EQ(stops_of(read_program("G0 X1\nX2\n" + std::string(stop) + "\nX3")), Stops{1}) << stop;
  }
  EXPECT_EQ(stops_of(read_program("G0 X1\nX2 M0\nX3")), Stops{1});
  EXPECT_EQ(stops_of(read_program("G0 X1\nX2 M6\nX3")), Stops{0});
}

}  // namespace
}  // namespace kcs::gcode
