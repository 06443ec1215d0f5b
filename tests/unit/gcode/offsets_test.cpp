// What shifts and turns the program's coordinates, and the positions that it stores.
#include <gtest/gtest.h>

#include "tests/unit/gcode/program.h"

namespace kcs::gcode {
namespace {

using planning::Vector;

void expect_end(const std::string& program, const Vector& end) {
  EXPECT_NEAR((read_program(program).end() - end).norm(), 0, 1e-12) << program;
}

TEST(WorkOffsets, AreSetByTheProgram) {
  expect_end("G10 L2 P1 X10 Y20 Z30\nG0 X1 Y2 Z3", {11, 22, 33});
  expect_end("G10 L2 P2 X10\nG0 X1 Y1", {1, 1, 0});
  expect_end("G10 L2 P2 X10\nG0 X1\nG55 X1", {11, 0, 0});
  expect_end("G10 L2 P9 X10\nG59.3 G0 X1", {11, 0, 0});
  expect_end("G55\nG10 L2 P0 X10\nG0 X1", {11, 0, 0});
  expect_end("G20 G10 L2 P1 X1\nG0 X1", {50.8, 0, 0});
}

TEST(WorkOffsets, AreSetByWhereTheToolIs) {
  expect_end("G0 X10 Y10\nG10 L20 P1 X1\nG0 X0", {9, 10, 0});
  expect_end("G0 X10 Y20\nG10 L2 P2 R90\nG10 L20 P2 X1 Y2\nG55 G0 X0 Y0", {12, 19, 0});
  expect_end("G0 X10\nG92 X5\nG43.1 X1\nG10 L20 P1 X7\nG0 X0", {3, 0, 0});
}

TEST(WorkOffsets, TurnLinesAndArcs) {
  expect_end("G10 L2 P1 X10 R90\nG0 X1 Y0", {10, 1, 0});
  expect_end("G10 L2 P1 R90\nG91 G0 X1\nY1 Z1", {-1, 1, 1});
  const Program program = read_program("G10 L2 P1 R90\nG0 X1 Y0\nG3 X0 Y1 I-1 F60");
  for (const planning::Segment& segment : program.segments()) EXPECT_NEAR(segment.end.norm(), 1, 1e-12);
  EXPECT_NEAR((program.end() - Vector(-1, 0, 0)).norm(), 0, 1e-12);
  expect_end("G10 L2 P1 R90\nG0 X1 Y0\nG90.1 G3 X0 Y1 I0 J0 F60", {-1, 0, 0});
}

TEST(WorkOffsets, LeaveUnstatedAxesWhereTheyAre) {
  const Program program = read_program("G0 X0.1 Y0.3\nG10 L2 P1 X0.7 Y0.9 R30\nG0 Z1\nX1\nZ2");
  EXPECT_EQ(program.segments()[1].end, Vector(0.1, 0.3, 1));
  EXPECT_EQ(program.segments()[3].end.head<2>(), program.segments()[2].end.head<2>());
}

TEST(WorkOffsets, AreNotedWhereTheProgramReliesOnTheMachines) {
  EXPECT_EQ(read_program("G54\nG0 X1").notices.size(), 1U);
  EXPECT_TRUE(read_program("G10 L2 P1 X1\nG54\nG0 X1").notices.empty());
}

TEST(WorkOffsets, AreReadAsParameters) {
  expect_end("G10 L2 P2 X10 Y20 R45\nG0 X#5241 Y#5250", {10, 45, 0});
  expect_end("G92 X-3\nG0 X[#5211*2]", {9, 0, 0});
  expect_end("G43.1 Z4\nG0 X#5403 Y#<_tool_offset>", {4, 1, 0});
}

TEST(WorkOffsets, RefuseArcsThatTheyTurnOutOfTheirPlane) {
  EXPECT_NE(refusal_of("G10 L2 P1 R10\nG18 G2 X2 R1 F60").find("that is turned"), std::string::npos);
}

TEST(G10, RefusesWhatItCannotSet) {
  EXPECT_NE(refusal_of("G10 P1 X1").find("G10 needs L and P"), std::string::npos);
  EXPECT_NE(refusal_of("G10 L2 X1").find("G10 needs L and P"), std::string::npos);
  EXPECT_NE(refusal_of("G10 L2 P10 X1").find("1 to 9 for G54"), std::string::npos);
  EXPECT_NE(refusal_of("G10 L2 P1.5 X1").find("1 to 9 for G54"), std::string::npos);
  EXPECT_NE(refusal_of("G10 L10 P1 Z1").find("L10 and L11 measure a tool"), std::string::npos);
  EXPECT_NE(refusal_of("G10 L20 P1 X1 R1").find("with G10 L2 only"), std::string::npos);
  EXPECT_NE(refusal_of("G1 G10 L2 P1 X1").find("takes the axis words of its block"), std::string::npos);
}

TEST(ToolLengths, AreStatedByTheProgram) {
  expect_end("G43.1 Z5\nG0 Z1", {0, 0, 6});
  expect_end("G43.1 Z5\nG43.1 X1\nG0 X0 Z1", {1, 0, 6});
  expect_end("G43.1 Z5\nG49\nG0 Z1", {0, 0, 1});
  expect_end("G10 L1 P3 Z5\nG43 H3\nG0 Z1", {0, 0, 6});
  expect_end("G10 L1 P3 Z5\nT3 M6\nG43\nG0 Z1", {0, 0, 6});
  expect_end("G10 L1 P3 Z5\nG10 L1 P4 X1\nG43 H3\nG43.2 H4 G0 X0 Z1", {1, 0, 6});
  expect_end("G43.1 Z5\nG53 G0 Z1", {0, 0, 1});
}

TEST(ToolLengths, CountAsZeroWhereTheProgramDoesNotStateThem) {
  const Program program = read_program("G43 H7\nG0 Z1");
  EXPECT_EQ(program.end(), Vector(0, 0, 1));
  EXPECT_EQ(program.notices.size(), 1U);
  EXPECT_TRUE(read_program("G10 L1 P7 Z2\nG43 H7\nG0 Z1").notices.empty());
}

TEST(ToolLengths, RefuseWhatIsNoTool) {
  EXPECT_NE(refusal_of("G43 H1.5").find("a whole number"), std::string::npos);
  EXPECT_NE(refusal_of("T-1").find("a whole number"), std::string::npos);
  EXPECT_NE(refusal_of("G43.2").find("G43.2 needs"), std::string::npos);
  EXPECT_NE(refusal_of("G43.1").find("G43.1 needs"), std::string::npos);
  EXPECT_NE(refusal_of("G0 G43.1 Z1").find("takes the axis words"), std::string::npos);
}

TEST(G52, ShiftsTheCoordinatesByWhatItStates) {
  expect_end("G0 X5\nG52 X3\nG0 X1", {4, 0, 0});
  expect_end("G0 X5\nG52 X3\nG52 X0\nG0 X1", {1, 0, 0});
}

TEST(StoredPositions, AreGoneToPastAPointThatTheBlockStates) {
  const Program program = read_program("G0 X1 Y2 Z3\nG28.1\nG0 X10 Y10 Z0\nG28 Z5");
  EXPECT_EQ(program.segments()[2].end, Vector(10, 10, 5));
  EXPECT_EQ(program.end(), Vector(10, 10, 3));
  expect_end("G0 X1 Y2 Z3\nG30.1\nG92 X0\nG0 X10\nG30", {1, 2, 3});
  expect_end("G0 X1 Y2 Z3\nG28.1\nG0 X10\nG91 G28 X0", {1, 2, 3});
}

TEST(StoredPositions, OfTheMachineAreNotKnown) {
  EXPECT_NE(refusal_of("G28 Z0").find("Store one in the program (G28.1"), std::string::npos);
  EXPECT_NE(refusal_of("G28.1\nG30 Z0").find("Store one in the program (G30.1"), std::string::npos);
}

}  // namespace
}  // namespace kcs::gcode
