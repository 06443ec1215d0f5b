#include "client/gateway/player.h"

#include <gtest/gtest.h>

#include "tests/unit/gateway/allocations.h"

namespace kcs::gateway {
namespace {

TEST(Player, StandsAtTheStartBeforeTheFirstTick) {
  SetpointQueue queue(4);
  const Player player(queue, Vector(1, 2, 3));
  EXPECT_EQ(player.state(), PlayState::kReady);
  EXPECT_EQ(player.position_mm(), Vector(1, 2, 3));
  EXPECT_EQ(player.played(), 0u);
}

TEST(Player, PutsOutOneSetpointATickAndFinishesWithTheLast) {
  SetpointQueue queue(4);
  queue.put({.position_mm = Vector(1, 0, 0)});
  queue.put({.position_mm = Vector(2, 0, 0)});
  queue.put({.position_mm = Vector(3, 0, 0), .last = true});
  Player player(queue, Vector::Zero());
  EXPECT_EQ(player.tick(), PlayState::kPlaying);
  EXPECT_EQ(player.position_mm(), Vector(1, 0, 0));
  EXPECT_EQ(player.tick(), PlayState::kPlaying);
  EXPECT_EQ(player.position_mm(), Vector(2, 0, 0));
  EXPECT_EQ(player.tick(), PlayState::kFinished);
  EXPECT_EQ(player.position_mm(), Vector(3, 0, 0));
  EXPECT_EQ(player.played(), 3u);
}

TEST(Player, StaysAtTheEndAndTakesNothingMore) {
  SetpointQueue queue(4);
  queue.put({.position_mm = Vector(1, 0, 0), .last = true});
  queue.put({.position_mm = Vector(9, 9, 9)});
  Player player(queue, Vector::Zero());
  player.tick();
  EXPECT_EQ(player.tick(), PlayState::kFinished);
  EXPECT_EQ(player.position_mm(), Vector(1, 0, 0));
  EXPECT_EQ(player.played(), 1u);
  EXPECT_EQ(queue.size(), 1u);
}

TEST(Player, StarvationHoldsThePositionAndIsFinal) {
  SetpointQueue queue(4);
  queue.put({.position_mm = Vector(1, 0, 0)});
  Player player(queue, Vector::Zero());
  player.tick();
  EXPECT_EQ(player.tick(), PlayState::kStarved);
  EXPECT_EQ(player.position_mm(), Vector(1, 0, 0));
  queue.put({.position_mm = Vector(2, 0, 0)});  // too late: resuming at speed from standing still would be a jump
  EXPECT_EQ(player.tick(), PlayState::kStarved);
  EXPECT_EQ(player.position_mm(), Vector(1, 0, 0));
  EXPECT_EQ(player.played(), 1u);
}

TEST(Player, TickAllocatesNothing) {
  SetpointQueue queue(1000);
  for (int i = 0; i < 1000; ++i) queue.put({.position_mm = Vector(i, 0, 0)});
  Player player(queue, Vector::Zero());
  const std::size_t before = test::allocations();
  for (int i = 0; i < 1001; ++i) player.tick();
  EXPECT_EQ(test::allocations(), before);
  EXPECT_EQ(player.state(), PlayState::kStarved);
}

}  // namespace
}  // namespace kcs::gateway
