#include "server/motion/sampler.h"

#include <gtest/gtest.h>

namespace kcs::motion {
namespace {

// X moves 1 mm in 1 s at constant speed, then 1 mm in 2 s.
Trajectory two_speeds() {
  Phase first{.duration = 1};
  first.start.velocity.x() = 1;
  Phase second{.start_time = 1, .duration = 2};
  second.start.position.x() = 1;
  second.start.velocity.x() = 0.5;
  Trajectory trajectory;
  trajectory.append(first);
  trajectory.append(second);
  trajectory.set_final_state({.position = Vector(2, 0, 0)});
  return trajectory;
}

TEST(Sampler, EndsOnTheFirstPeriodThatIsNotBeforeTheEnd) {
  const Trajectory trajectory = two_speeds();
  EXPECT_EQ(Sampler(trajectory, 1).count(), 4u);
  EXPECT_EQ(Sampler(trajectory, 0.1).count(), 31u);
  EXPECT_EQ(Sampler(trajectory, 0.7).count(), 6u);
  EXPECT_EQ(Sampler(trajectory, 10).count(), 2u);
}

TEST(Sampler, GivesPositionsOnThePeriod) {
  const Trajectory trajectory = two_speeds();
  Sampler sampler(trajectory, 0.5);
  EXPECT_DOUBLE_EQ(sampler.at(0).state.position.x(), 0);
  EXPECT_DOUBLE_EQ(sampler.at(1).state.position.x(), 0.5);
  EXPECT_DOUBLE_EQ(sampler.at(2).state.position.x(), 1);
  EXPECT_DOUBLE_EQ(sampler.at(3).state.position.x(), 1.25);
}

TEST(Sampler, EndsAtRestOnTheExactEnd) {
  const Trajectory trajectory = two_speeds();
  Sampler sampler(trajectory, 0.7);
  const Setpoint last = sampler.at(sampler.count() - 1);
  EXPECT_EQ(last.state.position, Vector(2, 0, 0));
  EXPECT_EQ(last.state.velocity, Vector(0, 0, 0));
}

TEST(Sampler, GivesTheSameSetpointWhateverWasAskedBefore) {
  Trajectory trajectory;
  for (int i = 0; i < 1000; ++i) {
    Phase phase{.start_time = trajectory.duration(), .duration = 0.01};
    phase.start.position.y() = i * i;
    trajectory.append(phase);
  }
  Sampler forward(trajectory, 0.003), jumping(trajectory, 0.003);
  std::vector<Vector> expected;
  for (std::uint64_t i = 0; i < forward.count(); ++i) expected.push_back(forward.at(i).state.position);
  std::uint64_t index = 0;
  for (std::uint64_t i = 0; i < forward.count(); ++i) {
    index = (index + 1237) % forward.count();
    ASSERT_EQ(jumping.at(index).state.position, expected[index]) << index;
  }
}

TEST(Sampler, HasOneSetpointForNoMotion) {
  Trajectory trajectory;
  trajectory.set_final_state({.position = Vector(1, 2, 3)});
  Sampler sampler(trajectory, 0.001);
  EXPECT_EQ(sampler.count(), 1u);
  EXPECT_EQ(sampler.at(0).state.position, Vector(1, 2, 3));
}

}  // namespace
}  // namespace kcs::motion
