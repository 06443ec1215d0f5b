// The verifier beside a motion that is still being made.

#include <gtest/gtest.h>
#include <malloc.h>

#include <array>
#include <cmath>
#include <vector>

#include "server/motion/verifier.h"
#include "tests/unit/motion/straight_moves.h"

namespace kcs::motion {
namespace {

const AxisLimits kLimits{2, Vector::Constant(1e4), Vector::Constant(1e5), Vector::Constant(1e4)};

// A zigzag with stops.
Vector corner(std::uint32_t index) { return {index * 1.0, index % 2 * 1.0, 0}; }

PathSegment segment(std::uint32_t index) {
  return {.end = corner(index + 1), .feed = 1e4, .tolerance = 0.01, .reach = 0.01, .rest = 0};
}

StraightMoves along_zigzag(std::uint32_t count) {
  StraightMoves moves;
  for (std::uint32_t i = 0; i < count; ++i) moves.go(corner(i), corner(i + 1), {i, i});
  return moves;
}

TEST(VerifierStream, FindsTheSameWheneverThePathArrives) {
  constexpr std::uint32_t kCount = 50;
  const StraightMoves moves = along_zigzag(kCount);
  Verifier early({.position = corner(0)}, kLimits), late({.position = corner(0)}, kLimits);
  for (std::uint32_t i = 0; i < kCount; ++i) early.add(segment(i));
  std::uint32_t added = 0;
  for (const Phase& phase : moves.phases) {
    early.follow(phase);
    while (added < kCount && late.settled_segments() <= phase.segments.last) late.add(segment(added++));
    late.follow(phase);
  }
  const Verification at_once = early.finish({.position = moves.end}), in_time = late.finish({.position = moves.end});
  EXPECT_EQ(at_once.fault, "");
  EXPECT_EQ(in_time.fault, "");
  EXPECT_EQ(at_once.max_velocity, in_time.max_velocity);
  EXPECT_EQ(at_once.max_acceleration, in_time.max_acceleration);
  EXPECT_EQ(at_once.max_jerk, in_time.max_jerk);
  EXPECT_EQ(at_once.max_feed, in_time.max_feed);
  EXPECT_EQ(at_once.max_contour_error, in_time.max_contour_error);
}

TEST(VerifierStream, FindsAMissedCornerWhenBothItsSidesAreLeft) {
  const std::array<Vector, 5> points{Vector(0, 0, 0), Vector(1, 0, 0), Vector(1, 5, 0), Vector(1, 0, 0),
                                     Vector(2, 0, 0)};
  Verifier verifier({.position = points[0]}, kLimits);
  for (std::size_t i = 1; i < points.size(); ++i) {
    verifier.add({.end = points[i], .feed = 1e4, .tolerance = 0.01, .reach = 0.01});
  }
  StraightMoves moves;
  moves.go(points[0], points[1], {0, 1});  // and over the tip at (1, 5)
  moves.go(points[3], points[4], {2, 3});
  moves.stand(1, points[4], {3, 3});
  for (std::size_t i = 0; i + 1 < moves.phases.size(); ++i) verifier.follow(moves.phases[i]);
  EXPECT_EQ(verifier.so_far().fault, "");
  verifier.follow(moves.phases.back());
  EXPECT_NE(verifier.so_far().fault.find("corner at (1, 5, 0)"), std::string::npos) << verifier.so_far().fault;
}

TEST(VerifierStream, ForgetsWhatTheMotionHasLeftBehind) {
  Verifier verifier({.position = corner(0)}, kLimits);
  auto travel = [&, time = 0.0](std::uint32_t from, std::uint32_t to) mutable {
    for (std::uint32_t i = from; i < to; ++i) {
      verifier.add(segment(i));
      StraightMoves move;
      move.go(corner(i), corner(i + 1), {i, i});
      for (Phase& phase : move.phases) {
        phase.start_time = time;
        time = phase.end_time();
        verifier.follow(phase);
      }
    }
  };
  travel(0, 1'000);
  const std::size_t before = mallinfo2().uordblks;
  travel(1'000, 50'000);
  EXPECT_LE(mallinfo2().uordblks, before + 1'000);
  EXPECT_EQ(verifier.finish({.position = corner(50'000)}).fault, "");
}

// A motion that begins and ends on the way: 10 mm, from 50 mm/s and 200 mm/s² to 100 mm/s.
class MovingEnds : public testing::Test {
 protected:
  MovingEnds() {
    Phase first{.duration = 0.5, .start = {Vector::Zero(), Vector(50, 0, 0), Vector(200, 0, 0)}};
    first.jerk = Vector(-400, 0, 0);
    const State at = first.at(first.duration);
    const Phase second{.start_time = 0.5, .duration = 0.25, .start = at};
    const Vector end = second.at(second.duration).position;
    trajectory_.append(first);
    trajectory_.append(second);
    trajectory_.set_final_state({end, at.velocity});
    points_ = {Vector::Zero(), end};
  }

  std::string fault() const {
    const std::array<double, 1> feed{200}, tolerance{0}, reach{0}, rest{-1};
    return verify(trajectory_,
                  {points_, feed, tolerance, reach, rest, start_velocity_, start_acceleration_, end_velocity_}, kLimits)
        .fault;
  }

  Trajectory trajectory_;
  std::array<Vector, 2> points_;
  Vector start_velocity_{50, 0, 0}, start_acceleration_{200, 0, 0}, end_velocity_{100, 0, 0};
};

TEST_F(MovingEnds, PassIfTheyAreAsAsked) { EXPECT_EQ(fault(), ""); }

TEST_F(MovingEnds, AreRestUnlessAskedFor) {
  start_velocity_ = Vector::Zero();
  EXPECT_NE(fault().find("velocity of X jumps"), std::string::npos) << fault();
}

TEST_F(MovingEnds, MustBeginWithTheAccelerationAskedFor) {
  start_acceleration_.x() += 1e-3;
  EXPECT_NE(fault().find("acceleration of X jumps"), std::string::npos) << fault();
}

TEST_F(MovingEnds, MustEndWithTheVelocityAskedFor) {
  end_velocity_.x() -= 1e-3;
  EXPECT_NE(fault().find("velocity of X jumps"), std::string::npos) << fault();
}

TEST_F(MovingEnds, MustNotPromiseAnotherEnd) {
  trajectory_.set_final_state({.position = points_[1]});
  EXPECT_NE(fault().find("the end is not"), std::string::npos) << fault();
}

}  // namespace
}  // namespace kcs::motion
