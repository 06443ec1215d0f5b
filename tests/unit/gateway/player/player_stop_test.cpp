// Leaving the stream of batches by the stop tail, and coming back.
#include <gtest/gtest.h>

#include "tests/unit/gateway/player/player_at_work.h"

namespace kcs::test {
namespace {

// Running, and well on its way.
class PlayerStop : public testing::Test {
 protected:
  PlayerStop() {
    work.switch_on();
    work.begin_run(1);
    work.feed(150);
    EXPECT_EQ(work.state(), KCS_PLAYER_RUNNING);
  }

  // Goes on to the end of the run, all of it inside the limits.
  void finish() {
    work.resume();
    EXPECT_TRUE(work.feed_until(KCS_PLAYER_RUNNING));
    EXPECT_TRUE(work.feed_until(KCS_PLAYER_READY));
    EXPECT_EQ(work.reason(), KCS_PLAYER_END);
    EXPECT_NEAR(work.place(), work.kLengthMm, 1e-9);
    EXPECT_LE(work.watch.largest_share(), kAtTheLimit);
  }

  PlayerAtWork work;
};

TEST_F(PlayerStop, StarvedItPlaysTheTailAndStands) {
  ASSERT_TRUE(work.tick_until(KCS_PLAYER_STOPPING));
  EXPECT_EQ(work.report().starvations, 1u);
  EXPECT_EQ(work.report().branch, 1u);
  EXPECT_EQ(work.reason(), KCS_PLAYER_STARVED);
  const std::uint32_t tail = work.player->copies[work.player->current].batch.tail;
  ASSERT_GT(tail, 10u);
  double place = work.place();
  for (std::uint32_t i = 1; i < tail; ++i) {
    work.tick();
    ASSERT_EQ(work.state(), KCS_PLAYER_STOPPING);
    ASSERT_GE(work.place(), place);
    place = work.place();
  }
  work.tick();
  EXPECT_EQ(work.state(), KCS_PLAYER_HELD);
  const std::uint64_t played = work.report().played;
  work.tick(100);
  EXPECT_EQ(work.place(), place);
  EXPECT_EQ(work.report().played, played);
  EXPECT_EQ(work.report().starvations, 1u);
  finish();
}

TEST_F(PlayerStop, AskedToItStopsAfterTheBatchThatItIsIn) {
  kcs_player_ask_to_stop(work.memory.get());
  int ticks = 0;
  for (; work.state() == KCS_PLAYER_RUNNING; ++ticks) {
    EXPECT_EQ(work.report().stops_obeyed, 0u);
    work.feed(1);
  }
  EXPECT_LE(ticks, static_cast<int>(work.kBatch));
  EXPECT_EQ(work.state(), KCS_PLAYER_STOPPING);
  EXPECT_EQ(work.report().stops_obeyed, 1u);
  EXPECT_EQ(work.reason(), KCS_PLAYER_ASKED);
  EXPECT_EQ(work.report().starvations, 0u);
  ASSERT_TRUE(work.tick_until(KCS_PLAYER_HELD));
  EXPECT_GT(work.report().stale, 0u) << "what was there for the branch that it left";
  finish();
}

TEST_F(PlayerStop, ATouchOfTheHoldInputIsEnough) {
  work.input.hold = true;
  work.feed(1);
  work.input.hold = false;
  ASSERT_TRUE(work.feed_until(KCS_PLAYER_HELD));
  EXPECT_EQ(work.reason(), KCS_PLAYER_ASKED);
  finish();
}

TEST_F(PlayerStop, NothingBeginsWhileHoldIsOn) {
  work.input.hold = true;
  ASSERT_TRUE(work.feed_until(KCS_PLAYER_HELD));
  work.resume();
  const double place = work.place();
  work.feed(300);
  EXPECT_EQ(work.state(), KCS_PLAYER_HELD);
  EXPECT_EQ(work.place(), place);
  work.input.hold = false;
  work.feed(1);
  EXPECT_EQ(work.state(), KCS_PLAYER_RUNNING);
  ASSERT_TRUE(work.feed_until(KCS_PLAYER_READY));
  EXPECT_LE(work.watch.largest_share(), kAtTheLimit);
}

TEST_F(PlayerStop, WhatIsOnItsWayForTheFormerBranchIsDropped) {
  kcs_player_ask_to_stop(work.memory.get());
  ASSERT_TRUE(work.tick_until(KCS_PLAYER_HELD));
  const double place = work.place();
  const std::uint64_t stale = work.report().stale;
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(work.put_next());
    work.tick(20);
  }
  EXPECT_EQ(work.report().stale, stale + 5);
  EXPECT_EQ(work.state(), KCS_PLAYER_HELD);
  EXPECT_EQ(work.place(), place);
  finish();
}

TEST_F(PlayerStop, BatchesOfTheNextBranchWaitForTheEndOfTheTail) {
  ASSERT_TRUE(work.tick_until(KCS_PLAYER_STOPPING));
  const kcs_player_batch& played = work.player->copies[work.player->current].batch;
  const double end = work.line.place_of(played.position_mm[played.setpoints + played.tail - 1]);
  work.run.begin(1, 1, played.first_tick + played.setpoints + played.tail, end);
  work.put_next();
  work.put_next();
  ASSERT_TRUE(work.feed_until(KCS_PLAYER_HELD) && work.feed_until(KCS_PLAYER_READY));
  EXPECT_NEAR(work.place(), work.kLengthMm, 1e-9);
  EXPECT_LE(work.watch.largest_share(), kAtTheLimit);
}

TEST_F(PlayerStop, AStopWhileHeldMakesVoidWhatWasAboutToBegin) {
  ASSERT_TRUE(work.tick_until(KCS_PLAYER_HELD));
  const double place = work.place();
  work.resume();
  work.put_next();
  work.put_next();
  kcs_player_ask_to_stop(work.memory.get());
  work.tick(50);
  EXPECT_EQ(work.report().stops_obeyed, 1u);
  EXPECT_EQ(work.report().branch, 2u);
  work.put_next();  // was on its way
  work.tick(50);
  EXPECT_EQ(work.state(), KCS_PLAYER_HELD);
  EXPECT_EQ(work.place(), place);
  EXPECT_EQ(work.report().stale, 3u);
  finish();
}

TEST_F(PlayerStop, AStopBeforeTheFirstSetpointKeepsTheRunFromBeginning) {
  PlayerAtWork fresh;
  fresh.switch_on();
  fresh.begin_run(1);
  fresh.put_next();
  kcs_player_ask_to_stop(fresh.memory.get());
  fresh.tick(100);
  EXPECT_EQ(fresh.state(), KCS_PLAYER_READY);
  EXPECT_EQ(fresh.report().stale, 1u);
  EXPECT_EQ(fresh.report().stops_obeyed, 1u);
}

TEST_F(PlayerStop, AskedAgainWhileStoppingItGoesOnStopping) {
  ASSERT_TRUE(work.tick_until(KCS_PLAYER_STOPPING));
  kcs_player_ask_to_stop(work.memory.get());
  work.tick(2);
  EXPECT_EQ(work.report().stops_obeyed, 1u);
  EXPECT_EQ(work.report().branch, 1u);
  ASSERT_TRUE(work.tick_until(KCS_PLAYER_HELD));
  finish();
}

TEST_F(PlayerStop, AStopInTheLastBatchFindsTheEndOfTheRun) {
  while (!work.run.over()) work.feed(1);
  while (work.player->copies[work.player->current].batch.last == 0) work.tick();
  kcs_player_ask_to_stop(work.memory.get());
  ASSERT_TRUE(work.tick_until(KCS_PLAYER_READY));
  EXPECT_EQ(work.reason(), KCS_PLAYER_END);
  work.tick();
  EXPECT_EQ(work.report().stops_obeyed, 1u);
  EXPECT_NEAR(work.place(), work.kLengthMm, 1e-9);
}

TEST_F(PlayerStop, AnotherRunDoesNotBeginWhileItMovesButWhenItIsHeld) {
  work.run.begin(2, 0, 0, work.place());
  work.put_next();
  ASSERT_TRUE(work.tick_until(KCS_PLAYER_HELD));
  EXPECT_EQ(work.report().stale, 1u);
  EXPECT_EQ(work.report().run, 1u);
  work.begin_run(2);
  ASSERT_TRUE(work.feed_until(KCS_PLAYER_RUNNING));
  EXPECT_EQ(work.report().run, 2u);
  EXPECT_EQ(work.report().branch, 0u);
  ASSERT_TRUE(work.feed_until(KCS_PLAYER_READY));
  EXPECT_LE(work.watch.largest_share(), kAtTheLimit);
}

TEST_F(PlayerStop, ABatchThatEndsAtRestNeedsNoTail) {
  ASSERT_TRUE(work.tick_until(KCS_PLAYER_HELD));
  work.put(*work.standing(30, 0));
  ASSERT_TRUE(work.tick_until(KCS_PLAYER_RUNNING));
  work.tick(30);
  EXPECT_EQ(work.state(), KCS_PLAYER_HELD);
  EXPECT_EQ(work.report().branch, 2u);
  EXPECT_EQ(work.report().starvations, 2u);
  finish();
}

// Two batches, each of which goes to the limit of jerk from rest to rest: too close together they would go beyond it.
TEST(PlayerRest, ItRestsLongEnoughForTheNextBatchToBeginFromRest) {
  PlayerAtWork work;
  work.switch_on();
  work.tick(10);
  const double step = 0.9 * work.profile.jerk_mm_s3[1] * 1e-9;
  const auto put_bump = [&] {
    auto batch = work.standing(1, 1);
    batch->position_mm[0][1] += step;
    batch->position_mm[1][1] += 2 * step;
    work.put(*batch);
  };
  put_bump();
  ASSERT_TRUE(work.tick_until(KCS_PLAYER_STOPPING));
  put_bump();
  ASSERT_TRUE(work.tick_until(KCS_PLAYER_HELD) && work.tick_until(KCS_PLAYER_STOPPING));
  ASSERT_TRUE(work.tick_until(KCS_PLAYER_HELD));
  EXPECT_EQ(work.report().played, 4u);
  EXPECT_LE(work.watch.largest_share(), kAtTheLimit);
}

}  // namespace
}  // namespace kcs::test
