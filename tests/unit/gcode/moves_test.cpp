// Lines, feeds, units, coordinates.
#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/gcode/program.h"

namespace kcs::gcode {
namespace {

using planning::Vector;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Moves, StartWhereTheOptionsSay) {
  Options options;
  options.start = {1, 2, 3};
  const Program program = read_program("G0 Y5", options);
  EXPECT_EQ(program.path.start, Vector(1, 2, 3));
  EXPECT_EQ(program.end(), Vector(1, 5, 3));
}

TEST(Moves, RapidAtTheRapidAndLinesAtTheFeed) {
  Options options;
  const std::string program = "G0 X1\nG1 X2 F600\nX3\nF1200 X4\nG0 X5\nG1 X6";
  const double feeds[] = {kInfinity, 10, 10, 20, kInfinity, 20};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(read_program(program).segments().at(i).feed, feeds[i]);
  options.rapid = 500;
  EXPECT_EQ(read_program(program, options).segments()[4].feed, 500);
}

TEST(Moves, TakeTheOverrideInsteadOfEveryFeedAndTheRapid) {
  Options options;
  options.feed = 7;
  const Program program = read_program("G0 X1\nG1 X2\nF600 X3\nG93 X4\nF0 G94 X5\nG2 X7 R1", options);
  EXPECT_GT(program.segments().size(), 6U);
  for (const planning::Segment& segment : program.segments()) EXPECT_EQ(segment.feed, 7);
}

TEST(Moves, NeedAFeed) {
  EXPECT_TRUE(refusal_of("G0 X1\nN5 G1 X2").starts_with("gcode, line 2, column 4: no feed is set"));
  EXPECT_TRUE(refusal_of("G1 X2 F0").starts_with("gcode, line 1, column 1: no feed is set"));
  EXPECT_NE(refusal_of("G2 X2 R5"), "");
}

TEST(Moves, RefuseFeedsOutOfRange) {
  EXPECT_NE(refusal_of("F-1").find("column 1: a feed below zero"), std::string::npos);
  EXPECT_NE(refusal_of("G1 X1 F100000000").find("column 7"), std::string::npos);
  EXPECT_NE(refusal_of("G1 X1 F.00001"), "");
}

TEST(Moves, TakeInchesForAllNumbersOfTheBlock) {
  const Program program = read_program("G1 X1 F60 G20\nG91 Y1\nG21 Y1");
  EXPECT_EQ(program.segments()[0].end, Vector(25.4, 0, 0));
  EXPECT_EQ(program.segments()[0].feed, 25.4);
  EXPECT_EQ(program.segments()[1].end, Vector(25.4, 25.4, 0));
  EXPECT_EQ(program.segments()[2].end, Vector(25.4, 26.4, 0));
  EXPECT_EQ(program.segments()[2].feed, 25.4);
}

TEST(Moves, IncrementalAndAbsolute) {
  EXPECT_EQ(read_program("G91 G0 X1 Y1\nX1\nG90 Y5 Z1\nG91 Z-3").end(), Vector(2, 5, -2));
}

TEST(Moves, OfNoLengthLeaveNoTrace) {
  const Program program = read_program("G0 X0\nG1 X0 Y0\nG1 X1 F60\nG1 X1\nG1 E5 F120\nG1 X2\nG93 G1 X2 F1\n");
  ASSERT_EQ(program.segments().size(), 2U);
  EXPECT_EQ(program.segments()[1].feed, 2);
}

TEST(Moves, NeedAMotionInForce) {
  EXPECT_NE(refusal_of("X1").find("no motion is in force"), std::string::npos);
  EXPECT_NE(refusal_of("G0 X1\nG80\nX2").find("line 3"), std::string::npos);
  EXPECT_EQ(read_program("G0 X1\nG80\nG0 X2").end().x(), 2);
}

TEST(Moves, InverseTimeTakesTheTimeOfEachBlock) {
  const Program program = read_program("G93 G1 X10 F60\nX30 F30\nG2 I-5 F60\nG94 F60 G1 X0");
  EXPECT_EQ(program.segments()[0].feed, 10);  // 10 mm in 1 s
  EXPECT_EQ(program.segments()[1].feed, 10);  // 20 mm in 2 s
  EXPECT_NEAR(program.segments()[2].feed, 31.41592653589793, 1e-12);
  EXPECT_EQ(program.segments().back().feed, 1);
}

TEST(Moves, InverseTimeNeedsFInEachBlockAndLeavesNoFeedBehind) {
  EXPECT_NE(refusal_of("G93 G1 X1 F60\nX2").find("line 2, column 1: with G93"), std::string::npos);
  EXPECT_NE(refusal_of("F60\nG93 G1 X1 F60\nG94 X2").find("line 3, column 1: no feed"), std::string::npos);
  EXPECT_EQ(refusal_of("G93 G0 X1"), "");
}

TEST(Moves, AxesOfTwoAxisMachines) {
  Options options;
  options.axes = 2;
  EXPECT_EQ(read_program("G0 X1 Y2\nG2 I1 F60", options).end(), Vector(1, 2, 0));
  EXPECT_NE(refusal_of("G0 X1\nG0 X2 Z0", options).find("line 2, column 7: a Z word"), std::string::npos);
  EXPECT_NE(refusal_of("G18\nG2 X2 R1 F60", options).find("line 2"), std::string::npos);
}

TEST(Moves, AxesThatNoMachineHasMayOnlyBeZero) {
  EXPECT_EQ(read_program("G0 X1 A0 B0.").notices.size(), 2U);
  for (const char letter : std::string("ABCUVW")) {
    EXPECT_NE(refusal_of("G0 X1 " + std::string(1, letter) + "5").find("column 7: the machine has no axis"),
              std::string::npos);
  }
}

TEST(Moves, FarAwayAreRefused) {
  EXPECT_NE(refusal_of("G0 X1 Y10000001").find("column 7"), std::string::npos);
  EXPECT_NE(refusal_of("G91 G0 X9000000\nX9000000").find("line 2, column 1"), std::string::npos);
}

TEST(Moves, ThroughG92ComeInProgramCoordinates) {
  EXPECT_EQ(read_program("G0 X5 Y5\nG92 X0 Z1\nG0 X1 Z1\n").end(), Vector(6, 5, 0));
  EXPECT_EQ(read_program("G0 X5\nG92 X0\nG92 X10\nG0 X11\n").end(), Vector(6, 0, 0));
  EXPECT_EQ(read_program("G20 G0 X1\nG92 X0\nG0 X1\n").end(), Vector(50.8, 0, 0));
  EXPECT_EQ(read_program("G0 X5\nG91 G92 X0\nG90 G0 X1\n").end(), Vector(6, 0, 0));
}

TEST(Moves, AfterG92AreSuspendedRestoredAndCleared) {
  EXPECT_EQ(read_program("G0 X5\nG92 X0\nG92.2\nG0 X1").end().x(), 1);
  EXPECT_EQ(read_program("G0 X5\nG92 X0\nG92.2\nG92.3\nG0 X1").end().x(), 6);
  EXPECT_EQ(read_program("G0 X5\nG92 X0\nG92.1\nG92.3\nG0 X1").end().x(), 1);
}

TEST(Moves, G92MovesNothingItself) {
  EXPECT_EQ(read_program("G0 X5\nG92 X0").segments().size(), 1U);
  EXPECT_NE(refusal_of("G1 G92 X0"), "");
  EXPECT_NE(refusal_of("G92").find("at least one"), std::string::npos);
  const Program printer = read_program("G0 X5\nG92 E0\nG0 X6");
  EXPECT_EQ(printer.end().x(), 6);
  ASSERT_EQ(printer.notices.size(), 2U);
}

TEST(Moves, G53TakesMachineCoordinatesForItsBlock) {
  EXPECT_EQ(read_program("G0 X5\nG92 X0\nG53 G0 X1\n").end().x(), 1);
  EXPECT_EQ(read_program("G0 X5\nG92 X0\nG53 G0 X1\nX1").end().x(), 6);
  EXPECT_NE(refusal_of("G91 G53 G0 X1").find("column 5: G53"), std::string::npos);
  EXPECT_NE(refusal_of("G53 G2 X1 R1 F60"), "");
}

TEST(Moves, WorkOffsetsCountAsZero) {
  for (const char* offset : {"G54", "G55", "G59", "G59.1", "G59.3"}) {
    const Program program = read_program(std::string(offset) + " G0 X5");
    EXPECT_EQ(program.end().x(), 5);
    EXPECT_EQ(program.notices.size(), 1U);
  }
}

TEST(Moves, TakeARadiusAndAnAngleAboutTheProgramsZero) {
  const Program program = read_program("G0 @10 ^90\n^180\n@5\nG91 @1 ^90\nZ2");
  const Vector ends[] = {{0, 10, 0}, {-10, 0, 0}, {-5, 0, 0}, {0, -6, 0}, {0, -6, 2}};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR((program.segments().at(i).end - ends[i]).norm(), 0, 1e-12) << i;
  EXPECT_NEAR((read_program("G92 X-5\nG0 @10 ^0").end() - Vector(15, 0, 0)).norm(), 0, 1e-12);
}

TEST(Moves, RefuseARadiusAndAnAngleWhereTheyMeanNothing) {
  EXPECT_NE(refusal_of("G0 X1 @2").find("column 7: a radius (@) or an angle (^) beside X or Y"), std::string::npos);
  EXPECT_NE(refusal_of("G0 @2").find("the tool is at the zero of X and Y"), std::string::npos);
  EXPECT_NE(refusal_of("G91 G0 ^2").find("the tool is at the zero of X and Y"), std::string::npos);
  EXPECT_NE(refusal_of("G92 @2").find("@ and ^ state where a move ends"), std::string::npos);
  EXPECT_NE(refusal_of("G53 G0 @2 ^1").find("G53 goes with"), std::string::npos);
}

}  // namespace
}  // namespace kcs::gcode
