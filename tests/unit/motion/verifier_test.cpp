// The verifier must notice every kind of fault: each test breaks a good trajectory in one way.

#include "server/motion/verifier.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "server/motion/jlap.h"
#include "tests/unit/motion/straight_moves.h"

namespace kcs::motion {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class VerifierTest : public testing::Test {
 protected:
  // X from 0 to 10 mm, rest to rest, A = 2000, J = 1e5, up to 100 mm/s.
  VerifierTest() {
    LinearState state;
    const double ramp = ramp_to_peak(0, 0, 100, 2000, 1e5).distance;
    add(jlap(0, 0, 100, 0, 2000, 1e5), state);
    add({LinearPhase{(10 - 2 * ramp) / 100, 0}}, state);
    add(jlap(100, 0, 0, 0, 2000, 1e5), state);
    moves_.end = points_[1];
  }

  void add(const Jlap& profile, LinearState& state) {
    for (const LinearPhase& phase : profile) {
      if (phase.duration == 0) continue;
      const double time = moves_.phases.empty() ? 0 : moves_.phases.back().end_time();
      Phase piece{.start_time = time, .duration = phase.duration, .segments = {0, 0}};
      piece.start = {Vector(state.position, 0, 0), Vector(state.velocity, 0, 0), Vector(state.acceleration, 0, 0)};
      piece.jerk = Vector(phase.jerk, 0, 0);
      moves_.phases.push_back(piece);
      state = phase.end(state);
    }
  }

  Verification verification() const {
    return verify(moves_.trajectory(), {points_, feeds_, tolerances_, reaches_, rests_}, limits_);
  }

  void expect_fault(const std::string& what) {
    EXPECT_NE(verification().fault.find(what), std::string::npos) << "found: '" << verification().fault << "'";
  }

  std::array<Vector, 2> points_{Vector(0, 0, 0), Vector(10, 0, 0)};
  std::array<double, 1> feeds_{100}, tolerances_{0}, reaches_{0}, rests_{-1};
  AxisLimits limits_{3, Vector(100, 100, 100), Vector(2000, 2000, 2000), Vector(1e5, 1e5, 1e5)};
  StraightMoves moves_;
};

TEST_F(VerifierTest, PassesAGoodTrajectoryAndSaysWhatItReaches) {
  const Verification found = verification();
  EXPECT_EQ(found.fault, "");
  EXPECT_NEAR(found.max_feed, 100, 1e-9);
  EXPECT_NEAR(found.max_velocity.x(), 100, 1e-9);
  EXPECT_NEAR(found.max_acceleration.x(), 2000, 1e-9);
  EXPECT_NEAR(found.max_jerk.x(), 1e5, 1e-9);
  EXPECT_EQ(found.max_velocity.y(), 0);
  EXPECT_LT(found.max_contour_error, 1e-12);
}

TEST_F(VerifierTest, FindsAVelocityOverItsLimit) {
  limits_.velocity.x() = 99.9999;
  expect_fault("velocity of X");
}

TEST_F(VerifierTest, FindsAnAccelerationOverItsLimit) {
  limits_.acceleration.x() = 1999.9999;
  expect_fault("acceleration of X");
}

TEST_F(VerifierTest, FindsAJerkOverItsLimit) {
  limits_.jerk.x() = 99999.99;
  expect_fault("jerk of X");
}

TEST_F(VerifierTest, FindsAFeedOverTheProgrammedOne) {
  feeds_[0] = 99.9999;
  expect_fault("the feed reaches");
}

TEST_F(VerifierTest, FindsAJumpOfThePosition) {
  moves_.phases[2].start.position.x() += 3e-9;
  expect_fault("position jumps");
}

TEST_F(VerifierTest, FindsAJumpOfTheVelocity) {
  moves_.phases[2].start.velocity.x() -= 1e-6;
  expect_fault("velocity of X jumps");
}

TEST_F(VerifierTest, FindsAJumpOfTheAcceleration) {
  moves_.phases[1].start.acceleration.x() -= 1e-5;
  expect_fault("acceleration of X jumps");
}

TEST_F(VerifierTest, FindsAMissingEnd) {
  moves_.phases.pop_back();
  expect_fault("jumps");
}

TEST_F(VerifierTest, FindsAWrongEnd) {
  moves_.end.x() = 10.00001;
  expect_fault("the end is not");
}

TEST_F(VerifierTest, FindsAWayOffThePath) {
  for (Phase& phase : moves_.phases) phase.start.position.y() = 1e-6;
  tolerances_[0] = 0.9e-6;
  EXPECT_FALSE(verification().passed());
  EXPECT_NEAR(verification().max_contour_error, 1e-6, 1e-12);
}

TEST_F(VerifierTest, FindsMotionOfAnAxisThatTheMachineHasNot) {
  limits_.axes = 2;
  for (Phase& phase : moves_.phases) phase.start.velocity.z() = 1e-3;
  expect_fault("of Z");
}

TEST_F(VerifierTest, FindsNumbersThatAreNone) {
  for (const double number : {kInfinity, std::numeric_limits<double>::quiet_NaN()}) {
    const StraightMoves good = moves_;
    moves_.phases[3].jerk.y() = number;
    EXPECT_FALSE(verification().passed());
    moves_ = good;
    moves_.phases[3].duration = number;
    EXPECT_FALSE(verification().passed());
    moves_ = good;
  }
}

TEST_F(VerifierTest, FindsAPhaseOfNoSegment) {
  moves_.phases[3].segments = {0, 1};
  expect_fault("follows no segment");
}

TEST_F(VerifierTest, FindsAGapInTime) {
  moves_.phases[3].start_time += 1e-3;
  expect_fault("does not start when");
}

TEST_F(VerifierTest, FindsAPathThatIsNotTravelled) {
  moves_.phases.clear();
  EXPECT_FALSE(verification().passed());
  points_[1] = points_[0] + Vector(1e-9, 0, 0);  // so near that nothing jumps
  moves_.end = points_[1];
  expect_fault("nothing of the path is travelled");
}

}  // namespace
}  // namespace kcs::motion
