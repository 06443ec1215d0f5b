// Switching on and off, and what fails.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/gateway/player/player_at_work.h"

namespace kcs::test {
namespace {

void expect_position(const double* seen, const std::array<double, 3>& wanted) {
  for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(seen[axis], wanted[axis]);
}

void set_actual(PlayerAtWork& work, const std::array<double, 3>& position) {
  std::copy(position.begin(), position.end(), work.input.actual_mm);
}

// Running, and well on its way.
class PlayerStates : public testing::Test {
 protected:
  PlayerStates() {
    work.switch_on();
    work.begin_run(1);
    work.feed(100);
    EXPECT_EQ(work.state(), KCS_PLAYER_RUNNING);
  }

  PlayerAtWork work;
};

TEST(PlayerSwitching, SwitchedOffItFollowsTheActualPosition) {
  PlayerAtWork work;
  for (const std::array<double, 3> position : {std::array{1.0, 2.0, 3.0}, std::array{-50.0, 0.5, 1e6}}) {
    set_actual(work, position);
    work.tick();
    EXPECT_EQ(work.state(), KCS_PLAYER_OFF);
    EXPECT_FALSE(work.output.drives_on);
    expect_position(work.output.command_mm, position);
  }
}

TEST(PlayerSwitching, SwitchingOnMovesNothing) {
  PlayerAtWork work;
  set_actual(work, {10, 20, 30});
  work.tick();
  set_actual(work, {10.5, 20.5, 30.5});
  work.input.enable = true;
  work.tick();
  EXPECT_EQ(work.state(), KCS_PLAYER_READY);
  EXPECT_TRUE(work.output.drives_on);
  expect_position(work.output.command_mm, {10.5, 20.5, 30.5});
  set_actual(work, {10.6, 20.4, 30.5});  // within the following error: the command stays
  work.tick();
  expect_position(work.output.command_mm, {10.5, 20.5, 30.5});
  EXPECT_NEAR(work.report().largest_following_error_mm[0], 0.1, 1e-12);
}

TEST(PlayerSwitching, WhatWasPutBeforeSwitchingOnDoesNotBeginWithIt) {
  PlayerAtWork work;
  work.tick();
  work.begin_run(1);
  work.put_next();
  work.tick(5);
  work.switch_on();
  work.tick(100);
  EXPECT_EQ(work.state(), KCS_PLAYER_READY);
  EXPECT_EQ(work.report().stale, 1u);
}

TEST(PlayerSwitching, ADriveFaultKeepsItFromSwitchingOn) {
  PlayerAtWork work;
  work.input.drive_fault = true;
  work.tick();
  EXPECT_EQ(work.state(), KCS_PLAYER_OFF);
  work.input.enable = true;
  work.tick();
  EXPECT_EQ(work.state(), KCS_PLAYER_FAULT);
  EXPECT_EQ(work.reason(), KCS_PLAYER_DRIVE_FAULT);
}

TEST(PlayerSwitching, APositionThatIsNoNumberIsADriveFault) {
  PlayerAtWork work;
  work.switch_on();
  const double command = work.output.command_mm[1];
  work.input.actual_mm[1] = NAN;
  kcs_player_tick(work.player.get(), &work.input, &work.output);
  EXPECT_EQ(work.state(), KCS_PLAYER_FAULT);
  EXPECT_EQ(work.reason(), KCS_PLAYER_DRIVE_FAULT);
  for (int i = 0; i < 5; ++i) kcs_player_tick(work.player.get(), &work.input, &work.output);
  EXPECT_EQ(work.output.command_mm[1], command);
}

TEST_F(PlayerStates, SwitchedOffWhileMovingItFails) {
  const std::uint64_t branch = work.report().branch;
  work.input.enable = false;
  work.tick();
  EXPECT_EQ(work.state(), KCS_PLAYER_FAULT);
  EXPECT_EQ(work.reason(), KCS_PLAYER_SWITCHED_OFF);
  EXPECT_TRUE(work.output.quick_stop);
  EXPECT_FALSE(work.output.drives_on);
  EXPECT_EQ(work.report().branch, branch + 1);
  work.tick();
  EXPECT_EQ(work.state(), KCS_PLAYER_OFF);
  EXPECT_FALSE(work.output.quick_stop);
  EXPECT_EQ(work.reason(), KCS_PLAYER_SWITCHED_OFF) << "what happened stays known";
}

TEST_F(PlayerStates, SwitchedOffAtRestItIsJustOff) {
  ASSERT_TRUE(work.tick_until(KCS_PLAYER_HELD));
  work.input.enable = false;
  work.tick();
  EXPECT_EQ(work.state(), KCS_PLAYER_OFF);
  EXPECT_FALSE(work.output.quick_stop);
  EXPECT_FALSE(work.output.drives_on);
}

TEST_F(PlayerStates, ARunIsOverWhenItIsSwitchedOff) {
  ASSERT_TRUE(work.tick_until(KCS_PLAYER_HELD));
  work.input.enable = false;
  work.tick();
  work.switch_on();
  work.resume();
  work.put_next();
  work.tick(50);
  EXPECT_EQ(work.state(), KCS_PLAYER_READY);
  EXPECT_EQ(work.report().stale, 1u);
  work.begin_run(2);
  EXPECT_TRUE(work.feed_until(KCS_PLAYER_RUNNING));
}

TEST_F(PlayerStates, ADriveFaultStopsAtOnceAndIsLatched) {
  work.input.drive_fault = true;
  work.tick();
  EXPECT_EQ(work.state(), KCS_PLAYER_FAULT);
  EXPECT_EQ(work.reason(), KCS_PLAYER_DRIVE_FAULT);
  EXPECT_TRUE(work.output.quick_stop);
  EXPECT_TRUE(work.output.drives_on) << "drives need power to brake";
  work.input.drive_fault = false;
  work.feed(50);
  EXPECT_EQ(work.state(), KCS_PLAYER_FAULT);
  work.input.enable = false;
  work.tick();
  EXPECT_EQ(work.state(), KCS_PLAYER_OFF);
  work.switch_on();
  EXPECT_EQ(work.reason(), KCS_PLAYER_NONE);
}

TEST_F(PlayerStates, InAFaultTheCommandFollowsTheDrives) {
  work.input.drive_fault = true;
  work.tick();
  set_actual(work, {5, 6, 7});
  work.tick();
  expect_position(work.output.command_mm, {5, 6, 7});
}

TEST_F(PlayerStates, DrivesThatDoNotFollowAreAFault) {
  work.input.actual_mm[2] -= 0.99;
  work.tick();
  ASSERT_EQ(work.state(), KCS_PLAYER_RUNNING);
  work.input.actual_mm[2] -= 1.01;
  work.tick();
  EXPECT_EQ(work.state(), KCS_PLAYER_FAULT);
  EXPECT_EQ(work.reason(), KCS_PLAYER_FOLLOWING_ERROR);
  EXPECT_NEAR(work.report().largest_following_error_mm[2], 1.01, 1e-9);
}

TEST_F(PlayerStates, DrivesThatLeaveTheirPlaceAtRestAreAFault) {
  ASSERT_TRUE(work.tick_until(KCS_PLAYER_HELD));
  work.input.actual_mm[0] += 1.5;
  work.tick();
  EXPECT_EQ(work.state(), KCS_PLAYER_FAULT);
  EXPECT_EQ(work.reason(), KCS_PLAYER_FOLLOWING_ERROR);
}

TEST_F(PlayerStates, AFaultAnswersAStopThatWasAskedFor) {
  kcs_player_ask_to_stop(work.memory.get());
  work.tick();
  work.input.drive_fault = true;
  work.tick();
  EXPECT_EQ(work.report().stops_obeyed, 1u);
}

}  // namespace
}  // namespace kcs::test
