// Spindle and coolant: what is switched where, and where the tool rests for it.
#include <gtest/gtest.h>

#include <ostream>
#include <utility>
#include <vector>

#include "tests/unit/gcode/program.h"

namespace kcs::gcode {
namespace {

using planning::MarkerKind;

// Where something is switched, and what.
struct Switched {
  double x;
  MarkerKind kind;
  float speed = 0;

  bool operator==(const Switched&) const = default;
  friend std::ostream& operator<<(std::ostream& out, const Switched& it) {
    return out << "at X" << it.x << ": " << static_cast<int>(it.kind) << " with " << it.speed;
  }
};
using List = std::vector<Switched>;

List switched_by(const Program& program) {
  List list;
  for (const planning::Segment& segment : program.segments()) {
    if (segment.marker.kind == MarkerKind::kNone) continue;
    list.push_back({segment.end.x(), segment.marker.kind, segment.marker.speed});
  }
  return list;
}

// Where the tool rests, mm.
std::vector<double> rests_of(const Program& program) {
  std::vector<double> rests;
  for (const planning::Segment& segment : program.segments()) {
    if (segment.stop) rests.push_back(segment.end.x());
  }
  return rests;
}

TEST(Spindle, TurnsBeforeTheMoveOfItsBlockAndTheToolRestsForIt) {
  const Program program = read_program("G0 X1\nX2 M3 S1000\nX3\nX4 M4\nX5 M5\nX6");
  EXPECT_EQ(switched_by(program), (List{{1, MarkerKind::kSpindleClockwise, 1000},
                                        {3, MarkerKind::kSpindleCounterclockwise, 1000},
                                        {4, MarkerKind::kSpindleOff}}));
  EXPECT_EQ(rests_of(program), (std::vector<double>{1, 3, 4}));
  EXPECT_TRUE(program.notices.empty());
}

TEST(Spindle, ChangesItsSpeedOnTheWay) {
  const Program program = read_program("S500\nG0 X1\nM3\nX2\nS800 X3\nM3 S900\nX4\nM5 S100\nX5\nS200 X6\nM3");
  EXPECT_EQ(switched_by(program), (List{{1, MarkerKind::kSpindleClockwise, 500},
                                        {2, MarkerKind::kSpindleClockwise, 800},
                                        {3, MarkerKind::kSpindleClockwise, 900},
                                        {4, MarkerKind::kSpindleOff},
                                        {6, MarkerKind::kSpindleClockwise, 200}}));
  EXPECT_EQ(rests_of(program), (std::vector<double>{1, 4, 6}));
}

TEST(Spindle, TakesNoSpeedThatMayBelongToAnUnknownWord) {
  EXPECT_EQ(switched_by(read_program("G0 X1\nM3 S500\nT1 M106 S255\nX2")),
            (List{{1, MarkerKind::kSpindleClockwise, 500}}));
}

TEST(Spindle, TurnsForASurfaceSpeedUntilG97) {
  const Program program = read_program("M3 S500\nG0 X1\nG96 D2500 S180\nX2 S200\nM4 X3\nG97 S600\nX4 M5\nX5");
  EXPECT_EQ(switched_by(program), (List{{0, MarkerKind::kSpindleClockwise, 500},
                                        {1, MarkerKind::kSpindleSpeedLimit, 2500},
                                        {1, MarkerKind::kSpindleSurfaceSpeed, 180},
                                        {1, MarkerKind::kSpindleSurfaceSpeed, 200},
                                        {2, MarkerKind::kSpindleCounterclockwise, 500},
                                        {2, MarkerKind::kSpindleSurfaceSpeed, 200},
                                        {3, MarkerKind::kSpindleCounterclockwise, 600},
                                        {3, MarkerKind::kSpindleOff}}));
  EXPECT_EQ(rests_of(program), (std::vector<double>{2, 3})) << "where it turns the other way, and stops";
  EXPECT_TRUE(program.notices.empty());
}

TEST(Spindle, TakesASurfaceSpeedBeforeItTurnsInFeetWhereTheProgramIsInInches) {
  EXPECT_EQ(switched_by(read_program("G20 G96 S1000\nG0 X1\nM3")),
            (List{{0, MarkerKind::kSpindleSpeedLimit, 0},
                  {25.4, MarkerKind::kSpindleClockwise, 0},
                  {25.4, MarkerKind::kSpindleSurfaceSpeed, 304.8F}}));
}

TEST(Spindle, RefusesASurfaceSpeedThatIsMissing) {
  EXPECT_NE(refusal_of("M3 S100\nG96 D100").find("line 2, column 1: G96 needs S"), std::string::npos);
  EXPECT_NE(refusal_of("G96 S100\nG0 X1 G97").find("line 2, column 7: G97 after G96 without S"), std::string::npos);
  EXPECT_EQ(refusal_of("G97"), "");
}

TEST(Spindle, StopsAtTheBottomOfG86AndTurnsAgainAboveIt) {
  const Program program = read_program("M3 S500\nG0 Z5\nF100 G98 G86 X1 Z-1 R1 P0.5\nG80");
  std::vector<std::pair<double, MarkerKind>> at;
  for (const planning::Segment& segment : program.segments()) {
    if (segment.marker.kind != MarkerKind::kNone) at.emplace_back(segment.end.z(), segment.marker.kind);
  }
  EXPECT_EQ(
      at, (std::vector<std::pair<double, MarkerKind>>{
              {0, MarkerKind::kSpindleClockwise}, {-1, MarkerKind::kSpindleOff}, {5, MarkerKind::kSpindleClockwise}}));
}

TEST(Spindle, RefusesASpeedOutOfRange) {
  EXPECT_NE(refusal_of("G0 X1\nM3 S-1").find("line 2, column 4: a spindle speed"), std::string::npos);
  EXPECT_NE(refusal_of("S1000001"), "");
}

TEST(Spindle, StopsForAToolChangeAndAtTheEnd) {
  const List expected = {{1, MarkerKind::kSpindleClockwise, 10},
                         {2, MarkerKind::kSpindleOff},
                         {2, MarkerKind::kSpindleClockwise, 10},
                         {3, MarkerKind::kSpindleOff}};
  EXPECT_EQ(switched_by(read_program("G0 X1\nM3 S10\nX2\nT2 M6\nM3\nX3\nM30")), expected);
  EXPECT_EQ(switched_by(read_program("G0 X1\nT2 M6\nM2")), List{});
}

TEST(Coolant, SwitchesOnTheWay) {
  const Program program = read_program("G0 X1 M7\nX2 M8\nM9 X3\nX4");
  EXPECT_EQ(switched_by(program),
            (List{{0, MarkerKind::kMistOn}, {1, MarkerKind::kFloodOn}, {2, MarkerKind::kCoolantOff}}));
  EXPECT_EQ(rests_of(program), std::vector<double>{});
}

TEST(Coolant, IsOffAtTheEnd) {
  EXPECT_EQ(switched_by(read_program("G0 X1 M8\nX2\nM2")),
            (List{{0, MarkerKind::kFloodOn}, {2, MarkerKind::kCoolantOff}}));
}

TEST(Markers, OfOneBlockComeInTheOrderOfRs274AndBeforeItsDwell) {
  const Program program = read_program("G0 X1\nG0 X2 M8 G4 P2 M3 S10\nG4 P1\nM9\nX3");
  ASSERT_EQ(program.segments().size(), 5u);
  const auto& segments = program.segments();
  EXPECT_EQ(segments[0].marker.kind, MarkerKind::kSpindleClockwise);
  EXPECT_EQ(segments[0].dwell, 0);
  EXPECT_EQ(segments[1].marker.kind, MarkerKind::kFloodOn);
  EXPECT_EQ(segments[1].end, segments[0].end);
  EXPECT_EQ(segments[1].dwell, 2);
  EXPECT_EQ(segments[2].end.x(), 2);
  EXPECT_EQ(segments[2].dwell, 1);
  EXPECT_EQ(segments[3].marker.kind, MarkerKind::kCoolantOff) << "after the dwell";
}

TEST(Markers, LeaveTheStopsOfAnExactPathWhereTheyAre) {
  EXPECT_EQ(rests_of(read_program("G61 G0 X1\nM7\nM8\nX2\nM9\nM7\nX2 Y1")), std::vector<double>{2});
}

}  // namespace
}  // namespace kcs::gcode
