// The verifier must notice every kind of fault: each test breaks a good trajectory in one way.

#include "server/motion/verifier.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "server/motion/jlap.h"

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
    trajectory_.end = points_[1];
  }

  void add(const Jlap& profile, LinearState& state) {
    for (const LinearPhase& phase : profile) {
      if (phase.duration == 0) continue;
      Phase piece{.start_time = trajectory_.duration(), .duration = phase.duration, .segments = {0, 0}};
      piece.start = {Vector(state.position, 0, 0), Vector(state.velocity, 0, 0), Vector(state.acceleration, 0, 0)};
      piece.jerk = Vector(phase.jerk, 0, 0);
      trajectory_.phases.push_back(piece);
      state = phase.end(state);
    }
  }

  Verification verification() const {
    return verify(trajectory_, {points_, feeds_, tolerances_, reaches_, rests_}, limits_);
  }

  void expect_fault(const std::string& what) {
    EXPECT_NE(verification().fault.find(what), std::string::npos) << "found: '" << verification().fault << "'";
  }

  std::array<Vector, 2> points_{Vector(0, 0, 0), Vector(10, 0, 0)};
  std::array<double, 1> feeds_{100}, tolerances_{0}, reaches_{0}, rests_{-1};
  AxisLimits limits_{3, Vector(100, 100, 100), Vector(2000, 2000, 2000), Vector(1e5, 1e5, 1e5)};
  Trajectory trajectory_;
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
  trajectory_.phases[2].start.position.x() += 3e-9;
  expect_fault("position jumps");
}

TEST_F(VerifierTest, FindsAJumpOfTheVelocity) {
  trajectory_.phases[2].start.velocity.x() -= 1e-6;
  expect_fault("velocity of X jumps");
}

TEST_F(VerifierTest, FindsAJumpOfTheAcceleration) {
  trajectory_.phases[1].start.acceleration.x() -= 1e-5;
  expect_fault("acceleration of X jumps");
}

TEST_F(VerifierTest, FindsAMissingEnd) {
  trajectory_.phases.pop_back();
  expect_fault("jumps");
}

TEST_F(VerifierTest, FindsAWrongEnd) {
  trajectory_.end.x() = 10.00001;
  expect_fault("the end is not");
}

TEST_F(VerifierTest, FindsAWayOffThePath) {
  for (Phase& phase : trajectory_.phases) phase.start.position.y() = 1e-6;
  tolerances_[0] = 0.9e-6;
  EXPECT_FALSE(verification().passed());
  EXPECT_NEAR(verification().max_contour_error, 1e-6, 1e-12);
}

TEST_F(VerifierTest, FindsMotionOfAnAxisThatTheMachineHasNot) {
  limits_.axes = 2;
  for (Phase& phase : trajectory_.phases) phase.start.velocity.z() = 1e-3;
  expect_fault("of Z");
}

TEST_F(VerifierTest, FindsNumbersThatAreNone) {
  for (const double number : {kInfinity, std::numeric_limits<double>::quiet_NaN()}) {
    const Trajectory good = trajectory_;
    trajectory_.phases[3].jerk.y() = number;
    EXPECT_FALSE(verification().passed());
    trajectory_ = good;
    trajectory_.phases[3].duration = number;
    EXPECT_FALSE(verification().passed());
    trajectory_ = good;
  }
}

TEST_F(VerifierTest, FindsAPhaseOfNoSegment) {
  trajectory_.phases[3].segments = {0, 1};
  expect_fault("follows no segment");
}

TEST_F(VerifierTest, FindsAGapInTime) {
  trajectory_.phases[3].start_time += 1e-3;
  expect_fault("does not start when");
}

TEST_F(VerifierTest, FindsAPathThatIsNotTravelled) {
  trajectory_.phases.clear();
  EXPECT_FALSE(verification().passed());
  points_[1] = points_[0] + Vector(1e-9, 0, 0);  // so near that nothing jumps
  trajectory_.end = points_[1];
  expect_fault("nothing of the path is travelled");
}

// Whether the path is travelled: what a distance to the path cannot show. Paths of lines, each moved along from rest to
// rest.
class TravelTest : public testing::Test {
 protected:
  void go(const Vector& from, const Vector& to, const SegmentRange& segments) {
    const double length = (to - from).norm();
    const Vector direction = (to - from) / length;
    // Up to the middle with jerk J, −J, −J, J: four phases of the same duration t; length = 2 J t³.
    const double t = std::cbrt(length / 2e4);
    LinearState state;
    for (const double jerk : {1e4, -1e4, -1e4, 1e4}) {
      const LinearPhase linear{t, jerk};
      Phase phase{.start_time = trajectory_.duration(), .duration = t, .segments = segments};
      phase.start = {from + state.position * direction, state.velocity * direction, state.acceleration * direction};
      phase.jerk = jerk * direction;
      trajectory_.phases.push_back(phase);
      state = linear.end(state);
    }
    trajectory_.end = to;
  }

  void stand(double duration, const Vector& point, const SegmentRange& segments) {
    trajectory_.phases.push_back({trajectory_.duration(), duration, {.position = point}, Vector::Zero(), segments});
  }

  std::string fault() const {
    const std::size_t n = points_.size() - 1;
    const std::vector<double> feed(n, 1e4), tolerance(n, 0.01), reach(n, 0.01);
    std::vector<double> rest = rests_;
    rest.resize(n, -1);
    const Verification found = verify(trajectory_, {points_, feed, tolerance, reach, rest}, limits_);
    return found.fault;
  }

  AxisLimits limits_{2, Vector::Constant(1e4), Vector::Constant(1e5), Vector::Constant(1e4)};
  std::vector<Vector> points_;
  std::vector<double> rests_;
  Trajectory trajectory_;
};

TEST_F(TravelTest, PassesWhatTravelsAllOfIt) {
  points_ = {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}};
  go(points_[0], points_[1], {0, 0});
  go(points_[1], points_[2], {1, 1});
  EXPECT_EQ(fault(), "");
}

TEST_F(TravelTest, FindsASpikeThatIsLeftOut) {
  points_ = {{0, 0, 0}, {10, 0, 0}, {10, 50, 0}, {10, 0, 0}, {20, 0, 0}};
  go(points_[0], points_[1], {0, 0});
  go(points_[3], points_[4], {3, 3});
  EXPECT_NE(fault().find("left out"), std::string::npos) << fault();
}

TEST_F(TravelTest, FindsASpikeThatIsLeftOutUnderItsName) {
  points_ = {{0, 0, 0}, {10, 0, 0}, {10, 50, 0}, {10, 0, 0}, {20, 0, 0}};
  go(points_[0], points_[1], {0, 2});
  go(points_[3], points_[4], {2, 3});
  EXPECT_NE(fault().find("corner at (10, 50, 0)"), std::string::npos) << fault();
}

TEST_F(TravelTest, FindsAClosedPathThatIsNotTravelled) {
  points_ = {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 0, 0}};
  stand(7, points_[0], {0, 0});
  EXPECT_NE(fault().find("left out"), std::string::npos) << fault();
}

TEST_F(TravelTest, FindsAClosedPathTravelledTheOtherWayRound) {
  points_ = {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 0, 0}};
  go(points_[0], points_[2], {2, 2});
  go(points_[2], points_[1], {1, 1});
  go(points_[1], points_[0], {0, 0});
  EXPECT_NE(fault().find("out of order"), std::string::npos) << fault();
}

TEST_F(TravelTest, FindsAWayBackOnALine) {
  points_ = {{0, 0, 0}, {10, 0, 0}};
  go({0, 0, 0}, {8, 0, 0}, {0, 0});
  go({8, 0, 0}, {5, 0, 0}, {0, 0});
  go({5, 0, 0}, {10, 0, 0}, {0, 0});
  EXPECT_NE(fault().find("goes back"), std::string::npos) << fault();
}

TEST_F(TravelTest, FindsARestThatIsLeftOutOrTooShort) {
  points_ = {{0, 0, 0}, {10, 0, 0}, {20, 0, 0}};
  rests_ = {0.5};
  go(points_[0], points_[1], {0, 0});
  stand(0.4, points_[1], {0, 0});
  const Trajectory first_half = trajectory_;
  go(points_[1], points_[2], {1, 1});
  EXPECT_NE(fault().find("does not rest"), std::string::npos) << fault();
  trajectory_ = first_half;
  stand(0.1, points_[1], {0, 0});
  go(points_[1], points_[2], {1, 1});
  EXPECT_EQ(fault(), "");
}

}  // namespace
}  // namespace kcs::motion
