// Playing a run, batch after batch.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/gateway/allocations.h"
#include "tests/unit/gateway/player/player_at_work.h"

namespace kcs::test {
namespace {

TEST(PlayerCore, PlaysEverySetpointOfARunOnceAndInOrder) {
  PlayerAtWork work;
  work.switch_on();
  work.begin_run(1);
  ASSERT_TRUE(work.feed_until(KCS_PLAYER_RUNNING));
  const LineMotion motion =
      LineMotion::travel(work.line.place_of(work.line.origin.data()), work.kLengthMm, work.limits);
  const int ticks = static_cast<int>(std::ceil(motion.duration_s() / work.kPeriodS));
  for (int tick = 1; tick <= ticks; ++tick) {
    ASSERT_EQ(work.state(), KCS_PLAYER_RUNNING);
    ASSERT_EQ(work.report().played, static_cast<std::uint64_t>(tick));
    ASSERT_NEAR(work.place(), motion.at(tick * work.kPeriodS).place, 1e-9);
    work.feed(1);
  }
  EXPECT_EQ(work.state(), KCS_PLAYER_READY);
  EXPECT_EQ(work.reason(), KCS_PLAYER_END);
  EXPECT_NEAR(work.place(), work.kLengthMm, 1e-9);
  EXPECT_EQ(work.report().played, static_cast<std::uint64_t>(ticks));
  EXPECT_EQ(work.report().batches, static_cast<std::uint64_t>((ticks + work.kBatch - 1) / work.kBatch));
  EXPECT_EQ(work.report().branch + work.report().starvations + work.report().refused + work.report().stale, 0u);
  EXPECT_GT(work.watch.largest_share(), 0.99) << "the motion was to go to the limits";
  EXPECT_LE(work.watch.largest_share(), kAtTheLimit);
}

TEST(PlayerCore, StandsAfterTheEndUntilAnotherRunBegins) {
  PlayerAtWork work;
  work.switch_on();
  work.begin_run(1);
  ASSERT_TRUE(work.feed_until(KCS_PLAYER_RUNNING) && work.feed_until(KCS_PLAYER_READY));
  const double end = work.place();
  const std::uint64_t played = work.report().played;
  work.tick(100);
  EXPECT_EQ(work.place(), end);
  EXPECT_EQ(work.report().played, played);

  // More of the run that is over is stale.
  work.run.begin(1, 0, played, end - 1);
  work.put_next();
  work.tick(10);
  EXPECT_EQ(work.state(), KCS_PLAYER_READY);
  EXPECT_EQ(work.report().stale, 1u);

  work.run = LineRun(work.line, work.limits, work.kPeriodS, work.kBatch, 2 * work.kLengthMm);
  work.begin_run(2);
  ASSERT_TRUE(work.feed_until(KCS_PLAYER_RUNNING));
  EXPECT_EQ(work.report().run, 2u);
  EXPECT_EQ(work.report().played, 1u);
  EXPECT_EQ(work.reason(), KCS_PLAYER_NONE);
  ASSERT_TRUE(work.feed_until(KCS_PLAYER_READY));
  EXPECT_NEAR(work.place(), 2 * work.kLengthMm, 1e-9);
  EXPECT_LE(work.watch.largest_share(), kAtTheLimit);
}

TEST(PlayerCore, ChecksOnlySoManySetpointsInATick) {
  PlayerAtWork work;
  work.switch_on();
  work.put(*work.standing(20, 100));
  work.tick();
  EXPECT_EQ(work.player->checked, static_cast<std::uint32_t>(KCS_PLAYER_CHECKS));
  EXPECT_EQ(work.memory->taken, 0u) << "the slot is not free before all of it has been copied";
}

TEST(PlayerCore, ChecksABatchAtOnceThatIsDue) {
  PlayerAtWork work;
  work.switch_on();
  work.begin_run(1);
  // Every batch comes at the last moment.
  for (int i = 0; i < 10; ++i) {
    work.put_next();
    ASSERT_TRUE(work.tick_until(KCS_PLAYER_RUNNING));
    work.tick(i == 0 ? work.kBatch - 1 : work.kBatch);
    ASSERT_EQ(work.state(), KCS_PLAYER_RUNNING);
  }
  EXPECT_EQ(work.report().starvations, 0u);
  EXPECT_EQ(work.report().played, 10 * work.kBatch);
  work.tick();
  EXPECT_EQ(work.state(), KCS_PLAYER_STOPPING);
}

TEST(PlayerCore, PutsMarkersOutAtTheirTick) {
  PlayerAtWork work;
  work.switch_on();
  work.begin_run(1);
  for (std::uint32_t i = 0; i < 3; ++i) {
    auto batch = work.next();
    batch->marker_count = 2;
    batch->markers[0] = {.setpoint = 5 + i, .kind = 1, .value = 1000.0 * i};
    batch->markers[1] = {.setpoint = 5 + i, .kind = 5, .value = 0};
    work.put(*batch);
  }
  ASSERT_TRUE(work.tick_until(KCS_PLAYER_RUNNING));
  for (std::uint64_t tick = 0; tick < 3 * work.kBatch; ++tick) {
    const std::uint64_t batch = tick / work.kBatch;
    const bool due = tick % work.kBatch == 5 + batch;
    ASSERT_EQ(work.output.marker_count, due ? 2u : 0u) << tick;
    if (due) {
      EXPECT_EQ(work.output.markers[0].value, 1000.0 * static_cast<double>(batch));
      EXPECT_EQ(work.output.markers[1].kind, 5u);
    }
    work.tick();
  }
  ASSERT_TRUE(work.tick_until(KCS_PLAYER_HELD));
  EXPECT_EQ(work.markers.size(), 6u);
}

TEST(PlayerCore, PutsMarkersOfATailOutIfItIsPlayed) {
  PlayerAtWork work;
  work.switch_on();
  work.begin_run(1);
  for (int i = 0; i < 2; ++i) {
    auto batch = work.next();
    ASSERT_GT(batch->tail, 3u);
    batch->marker_count = 1;
    batch->markers[0] = {.setpoint = batch->setpoints + 3, .kind = 5, .value = 1.0 * i};
    work.put(*batch);
  }
  ASSERT_TRUE(work.tick_until(KCS_PLAYER_STOPPING));
  EXPECT_TRUE(work.markers.empty());
  ASSERT_TRUE(work.tick_until(KCS_PLAYER_HELD));
  ASSERT_EQ(work.markers.size(), 1u);
  EXPECT_EQ(work.markers[0].value, 1);
}

TEST(PlayerCore, LeavesTheThirdAxisOfATwoAxisMachineAlone) {
  PlayerAtWork work;
  work.profile.axes = 2;
  work.memory = std::make_unique<kcs_player_memory>();
  kcs_player_prepare(work.memory.get(), &work.profile);
  ASSERT_TRUE(kcs_player_start(work.player.get(), work.memory.get()));
  work.switch_on();
  work.begin_run(1);
  ASSERT_TRUE(work.feed_until(KCS_PLAYER_RUNNING) && work.feed_until(KCS_PLAYER_READY));
  EXPECT_EQ(work.output.command_mm[2], 0);
  EXPECT_NEAR(work.output.command_mm[0], work.line.at(work.kLengthMm)[0], 1e-9);
}

TEST(PlayerCore, AllocatesNothing) {
  PlayerAtWork work;
  work.markers.reserve(100);
  work.switch_on();
  work.begin_run(1);
  work.put_next();
  work.put_next();
  const std::size_t before = allocations();
  work.tick(200);  // plays two batches and the tail, and stands
  EXPECT_EQ(allocations(), before);
  EXPECT_EQ(work.state(), KCS_PLAYER_HELD);
}

TEST(PlayerCore, ReportsWhatItDid) {
  PlayerAtWork work;
  work.switch_on();
  work.begin_run(7);
  work.feed(100);
  kcs_player_report report{};
  ASSERT_TRUE(kcs_player_read(work.memory.get(), &report));
  EXPECT_EQ(report.ticks, 101u);
  EXPECT_EQ(report.run, 7u);
  EXPECT_EQ(report.state, static_cast<std::uint32_t>(KCS_PLAYER_RUNNING));
  EXPECT_EQ(report.played, work.report().played);
  EXPECT_EQ(report.command_mm[1], work.output.command_mm[1]);
  EXPECT_EQ(report.largest_following_error_mm[0], 0);
}

TEST(PlayerCore, DoesNotStartOnAnotherLayoutOrAnUnsoundProfile) {
  PlayerAtWork work;
  const auto starts = [&work] { return kcs_player_start(work.player.get(), work.memory.get()); };
  EXPECT_TRUE(starts());
  for (double* number : {&work.memory->profile.period_s, &work.memory->profile.velocity_mm_s[0],
                         &work.memory->profile.acceleration_mm_s2[1], &work.memory->profile.jerk_mm_s3[2],
                         &work.memory->profile.following_error_mm[2]}) {
    const double good = *number;
    for (const double bad : {0.0, -1.0, double{NAN}, double{INFINITY}}) {
      *number = bad;
      EXPECT_FALSE(starts()) << bad;
    }
    *number = good;
    EXPECT_TRUE(starts());
  }
  for (const std::uint32_t axes : {0, 1, 4}) {
    work.memory->profile.axes = axes;
    EXPECT_FALSE(starts()) << axes;
  }
  work.memory->profile.axes = 3;
  ++work.memory->magic;
  EXPECT_FALSE(starts());
}

}  // namespace
}  // namespace kcs::test
