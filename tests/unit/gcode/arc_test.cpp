// Arcs: their shape in every plane, and their chords.
#include "server/gcode/arc.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/unit/gcode/program.h"

namespace kcs::gcode {
namespace {

using std::numbers::pi;

double length_of(const Program& program) {
  double length = 0;
  for (std::size_t i = 0; i < program.segments().size(); ++i) {
    length += (program.segments()[i].end - program.path.start_of(i)).norm();
  }
  return length;
}

// The path's point halfway along its chords.
Vector middle_of(const Program& program) {
  const std::size_t half = program.segments().size() / 2;
  if (program.segments().size() % 2 == 0) return program.path.start_of(half);
  return (program.path.start_of(half) + program.segments()[half].end) / 2;
}

Program arc_from(const Vector& start, const std::string& block, double tolerance = 0.01) {
  Options options;
  options.start = start;
  options.tolerance = tolerance;
  return read_program("F600 " + block, options);
}

struct Shape {
  const char* block;
  Vector start, middle, end;
  double length;
};

class Shapes : public testing::TestWithParam<Shape> {};

TEST_P(Shapes, PassThroughTheirMiddleToTheirEnd) {
  const Shape& shape = GetParam();
  const Program program = arc_from(shape.start, shape.block, 1e-6);
  EXPECT_EQ(program.end(), shape.end);
  EXPECT_NEAR(length_of(program), shape.length, 1e-5 * shape.length);
  EXPECT_LT((middle_of(program) - shape.middle).norm(), 1e-6);
}

const double kHalf = std::sqrt(0.5);

INSTANTIATE_TEST_SUITE_P(Arc, Shapes,
                         testing::Values(
                             // Quarter circles by centre: clockwise and counterclockwise in each plane.
                             Shape{"G17 G2 X1 Y0 I0 J-1", {0, 1, 0}, {kHalf, kHalf, 0}, {1, 0, 0}, pi / 2},
                             Shape{"G17 G3 X0 Y1 I-1 J0", {1, 0, 0}, {kHalf, kHalf, 0}, {0, 1, 0}, pi / 2},
                             Shape{"G17 G2 X0 Y1 I-1 J0", {1, 0, 0}, {-kHalf, -kHalf, 0}, {0, 1, 0}, 3 * pi / 2},
                             // G18: seen against +Y, Z points right and X up; clockwise goes from X to Z.
                             Shape{"G18 G2 X0 Z1 I-1 K0", {1, 0, 0}, {kHalf, 0, kHalf}, {0, 0, 1}, pi / 2},
                             Shape{"G18 G3 X1 Z0 I0 K-1", {0, 0, 1}, {kHalf, 0, kHalf}, {1, 0, 0}, pi / 2},
                             Shape{"G18 G3 X0 Z1 I-1 K0", {1, 0, 0}, {-kHalf, 0, -kHalf}, {0, 0, 1}, 3 * pi / 2},
                             // G19: seen against +X, Y points right and Z up; clockwise goes from Z to Y.
                             Shape{"G19 G2 Y1 Z0 J0 K-1", {0, 0, 1}, {0, kHalf, kHalf}, {0, 1, 0}, pi / 2},
                             Shape{"G19 G3 Y0 Z1 J-1 K0", {0, 1, 0}, {0, kHalf, kHalf}, {0, 0, 1}, pi / 2},
                             // Absolute centres.
                             Shape{"G90.1 G2 X2 Y1 I1 J1", {0, 1, 0}, {1, 2, 0}, {2, 1, 0}, pi},
                             // Full circles, with and without the end's words.
                             Shape{"G2 I1", {0, 0, 0}, {2, 0, 0}, {0, 0, 0}, 2 * pi},
                             Shape{"G3 X0 Y0 J-1", {0, 0, 0}, {0, -2, 0}, {0, 0, 0}, 2 * pi},
                             Shape{"G18 G2 K1", {0, 5, 0}, {0, 5, 2}, {0, 5, 0}, 2 * pi},
                             // Turns: one and a half, and three full ones.
                             Shape{"G3 X2 Y0 I1 P2", {0, 0, 0}, {1, 1, 0}, {2, 0, 0}, 3 * pi},
                             Shape{"G2 I1 P3", {0, 0, 0}, {2, 0, 0}, {0, 0, 0}, 6 * pi},
                             // By radius: the smaller arc, the larger one, half a circle.
                             Shape{"G2 X1 Y0 R1", {0, 1, 0}, {kHalf, kHalf, 0}, {1, 0, 0}, pi / 2},
                             Shape{"G3 X1 Y0 R1", {0, 1, 0}, {1 - kHalf, 1 - kHalf, 0}, {1, 0, 0}, pi / 2},
                             Shape{"G3 X1 Y0 R-1", {0, 1, 0}, {-kHalf, -kHalf, 0}, {1, 0, 0}, 3 * pi / 2},
                             Shape{"G2 X1 Y0 R-1", {0, 1, 0}, {1 + kHalf, 1 + kHalf, 0}, {1, 0, 0}, 3 * pi / 2},
                             Shape{"G2 X2 R1", {0, 0, 0}, {1, 1, 0}, {2, 0, 0}, pi},
                             Shape{"G3 X2 R-1", {0, 0, 0}, {1, -1, 0}, {2, 0, 0}, pi},
                             Shape{"G18 G2 X0 Z1 R1", {1, 0, 0}, {kHalf, 0, kHalf}, {0, 0, 1}, pi / 2},
                             // A helix of one turn, and half a turn in G19.
                             Shape{"G2 I1 Z3", {0, 0, 0}, {2, 0, 1.5}, {0, 0, 3}, std::hypot(2 * pi, 3)},
                             Shape{"G19 G3 Y-1 X4 J-1 Z0", {0, 1, 0}, {2, 0, 1}, {4, -1, 0}, std::hypot(pi, 4)},
                             // Inches.
                             Shape{"G20 G2 I1", {0, 0, 0}, {50.8, 0, 0}, {0, 0, 0}, 2 * pi * 25.4}));

TEST(Arc, TakesAbsoluteCentresInProgramCoordinates) {
  const Program program = read_program("G0 X5\nG92 X0 Y0\nG90.1 G3 X0 Y0 I1 J0 F60");
  for (std::size_t i = 1; i < program.segments().size(); ++i) {
    EXPECT_NEAR((program.segments()[i].end - Vector(6, 0, 0)).norm(), 1, 1e-12);
  }
}

TEST(Arc, IsAFullCircleThoughRoundingMovedItsEnd) {
  const Program program = read_program("G91 G0 X.1\nX.2\nG90 G2 X.3 I10 F60");
  EXPECT_NEAR(length_of(program), 0.3 + 20 * pi, 0.1);
}

TEST(Arc, RunsBackToTheStartInAllTurnsOfRandomArcs) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> number(-100, 100);
  for (int round = 0; round < 2000; ++round) {
    const Vector start(number(random), number(random), number(random));
    const Eigen::Vector2d centre(number(random), number(random));
    const double radius = (kPlaneXy.of(start) - centre).norm();
    const double angle = number(random);
    const Vector end(centre.x() + radius * std::cos(angle), centre.y() + radius * std::sin(angle), number(random));
    const Turn turn = round % 2 == 0 ? Turn::kClockwise : Turn::kCounterclockwise;
    const double tolerance = std::pow(10.0, -1 - round % 5);
    const Arc arc = Arc::about_centre(start, end, centre, kPlaneXy, turn, 1 + round % 3, {});
    const double chords = arc.chords_within(tolerance);
    const auto count = static_cast<std::size_t>(chords);
    EXPECT_LE(arc.chord_error(chords), tolerance);
    Vector last = start;
    for (std::size_t chord = 1; chord <= count; ++chord) {
      const Vector next = arc.chord_end(chord, count);
      EXPECT_NEAR((kPlaneXy.of(next) - centre).norm(), radius, 1e-11);
      const double sagitta = radius - (kPlaneXy.of((last + next) / 2) - centre).norm();
      EXPECT_LE(sagitta, tolerance);
      EXPECT_NEAR(sagitta, arc.chord_error(chords), 1e-11);
      EXPECT_NEAR((next - last).z(), (end - start).z() / chords, 1e-11);
      last = next;
    }
    EXPECT_EQ(last, end);
    // No more chords than needed: one less would leave the tolerance.
    if (chords > 4.0 * (1 + round % 3)) {
      EXPECT_GT(arc.chord_error(chords - 1), tolerance * (1 - 1e-3 - 1 / chords));
    }
  }
}

TEST(Arc, ByRadiusAgreesWithItsCentre) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> number(-100, 100);
  for (int round = 0; round < 2000; ++round) {
    const Vector start(number(random), number(random), 0);
    const Vector end(number(random), number(random), 0);
    const double radius = (end - start).norm() / 2 * (1 + std::abs(number(random)) / 10) * (round % 4 < 2 ? 1 : -1);
    const Turn turn = round % 2 == 0 ? Turn::kClockwise : Turn::kCounterclockwise;
    const Arc arc = Arc::of_radius(start, end, radius, kPlaneXy, turn, 1, {});
    EXPECT_EQ(arc.sweep() < pi, radius > 0);
    const Vector middle = arc.chord_end(1, 2);
    // The circle through start, middle and end has that radius.
    const double a = (middle - start).norm(), b = (end - middle).norm(), c = (end - start).norm();
    const double area =
        0.5 * std::abs((middle - start).x() * (end - start).y() - (middle - start).y() * (end - start).x());
    EXPECT_NEAR(a * b * c / (4 * area), std::abs(radius), 1e-6 * std::abs(radius));
    const double side = (end - start).x() * (middle - start).y() - (end - start).y() * (middle - start).x();
    EXPECT_EQ(side > 0, turn == Turn::kClockwise);
  }
}

TEST(Arc, SpreadsASmallRadiusMismatchEvenly) {
  const Program program = arc_from({10, 0, 0}, "G3 X-10.004 Y0 I-10");
  EXPECT_EQ(program.end(), Vector(-10.004, 0, 0));
  for (const planning::Segment& segment : program.segments()) {
    EXPECT_GT(segment.end.norm(), 10);
    EXPECT_LT(segment.end.norm(), 10.0041);
  }
}

TEST(Arc, NotesARadiusMismatchThatRoundingDoesNotExplain) {
  const struct {
    const char* block;
    std::size_t notices;
  } cases[] = {{"G3 X19.996 I10", 0},    // 0.004 mm
               {"G3 X19.98 I10", 1},     // 0.02 mm, 0.2 %
               {"G3 X1999.8 I1000", 0},  // 0.2 mm, 0.02 %
               {"G3 X1999.4 I1000", 1},  // 0.6 mm
               {"G3 X19.51 I10", 1}};    // 4.9 %
  for (const auto& [block, notices] : cases) EXPECT_EQ(arc_from({0, 0, 0}, block).notices.size(), notices) << block;
}

TEST(Arc, RefusesALargeRadiusMismatch) {
  const std::string refusal = refusal_of("F60 G3 X19.4 I10");
  EXPECT_TRUE(refusal.starts_with("gcode, line 1, column 1: the arc's start is 10.000000 mm from its centre"))
      << refusal;
}

TEST(Arc, WithoutCentreIsALineOnlyWhereG1WasForgotten) {
  const Program program = read_program("F60 G2 I1\nX3 Z1");
  EXPECT_EQ(program.segments().back().end, Vector(3, 0, 1));
  EXPECT_EQ(program.segments().back().line, 2U);
  ASSERT_EQ(program.notices.size(), 1U);
  EXPECT_EQ(program.notices[0].line, 2U);
  EXPECT_TRUE(refusal_of("F60 G2 I1\nG2 X3 Z1").starts_with("gcode, line 2, column 1: the arc's centre is missing"));
}

TEST(Arc, RefusesWhatIsNoArc) {
  EXPECT_NE(refusal_of("F60 G2 X1").find("centre is missing"), std::string::npos);
  EXPECT_NE(refusal_of("F60 G90.1 G2 X1 I1").find("G90.1 needs both"), std::string::npos);
  EXPECT_NE(refusal_of("F60 G2 X1 I0 J0").find("centre lies on"), std::string::npos);
  EXPECT_NE(refusal_of("F60 G2 X0 R1").find("elsewhere"), std::string::npos);
  EXPECT_NE(refusal_of("F60 G2 R1").find("elsewhere"), std::string::npos);
  EXPECT_NE(refusal_of("F60 G2 X1 R1 I1").find("radius (R) and a centre"), std::string::npos);
  EXPECT_NE(refusal_of("F60 G2 X1 R.49").find("farther than twice"), std::string::npos);
  EXPECT_NE(refusal_of("F60 G2 X2 I1 K1").find("no K"), std::string::npos);
  EXPECT_EQ(refusal_of("F60 G2 X2 I1 K0"), "");
  EXPECT_NE(refusal_of("F60 G2 X2 I1 P0").find("whole number"), std::string::npos);
  EXPECT_NE(refusal_of("F60 G2 X2 I1 P1.5").find("whole number"), std::string::npos);
  EXPECT_NE(refusal_of("F60 G2 X1 R9999999").find("as a line"), std::string::npos);
}

TEST(Arc, TakesAnEndThatRoundingPutTooFarAwayAsHalfACircle) {
  const Program program = arc_from({0, 0, 0}, "G2 X2.0018 R1");
  EXPECT_EQ(program.end().x(), 2.0018);
  EXPECT_NEAR(length_of(program), 1.0009 * pi, 0.01);
  ASSERT_EQ(program.notices.size(), 1U);
  EXPECT_NE(program.notices[0].text.find("half a circle of radius 1.000900 mm"), std::string::npos);
  EXPECT_TRUE(arc_from({0, 0, 0}, "G20 G2 X.2 R.1").notices.empty());
}

TEST(Arc, RefusesARadiusThatFallsShortByMoreThanRounding) {
  EXPECT_TRUE(
      refusal_of("F60 G3 X10 Y0 R4.998").starts_with("gcode, line 1, column 15: the arc's end is 10.000000 mm"));
  EXPECT_NE(refusal_of("F60 G2 X2.0022 R1"), "");
  EXPECT_NE(refusal_of("F60 G2 X2.0022 R-1"), "");
}

TEST(Arc, WithoutAnyWordOnlySetsTheMotion) {
  EXPECT_EQ(read_program("G2\nG1 X1 F60").segments().size(), 1U);
  EXPECT_GT(read_program("F60 G2\nI1").segments().size(), 3U);
}

TEST(Arc, SharesTheToleranceBetweenChordsAndSmoothing) {
  const Program program = arc_from({0, 0, 0}, "G2 I10", 0.02);
  for (const planning::Segment& segment : program.segments()) EXPECT_DOUBLE_EQ(segment.tolerance, 0.018);
  EXPECT_LE(program.chord_error, 0.002);
  EXPECT_GT(program.chord_error, 0.0018);
}

TEST(Arc, HasFourChordsAtLeast) { EXPECT_EQ(arc_from({0, 0, 0}, "G2 I0.001", 1).segments().size(), 4U); }

}  // namespace
}  // namespace kcs::gcode
