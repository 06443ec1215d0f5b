#include "client/gateway/machine/staging.h"

#include <gtest/gtest.h>

#include <random>

#include "client/gateway/machine/batch_check.h"
#include "client/gateway/machine/player_memory.h"
#include "tests/unit/gateway/machine/straight_motion.h"

namespace kcs::gateway {
namespace {

constexpr const char* kRun = "machines/bench/runs/3";
constexpr std::uint64_t kNumber = 3;
constexpr double kPeriod = 0.001;

class StagingTest : public testing::Test {
 protected:
  StagingTest() { staging_.begin(kNumber, 0); }

  v1::MotionBatch batch(std::uint64_t first, std::uint64_t count = 20, std::uint64_t branch = 0) const {
    return motion_.batch(kRun, branch, first, first, count);
  }
  StagingResult stage(std::uint64_t first, std::uint64_t count = 20) { return staging_.stage(batch(first, count)); }
  void stage_many(std::uint64_t batches) {
    for (std::uint64_t i = 0; i < batches; ++i) ASSERT_EQ(stage(i * 20).staged, Staged::kTaken);
  }
  // The player has played so far.
  void play(std::uint64_t tick) {
    staging_.follow({.state = KCS_PLAYER_RUNNING, .run = kNumber, .played = tick});
    memory_->taken = memory_->put;
  }

  StraightMotion motion_{0, 200, kPeriod};
  PlayerMemory memory_ = make_player_memory(test_profile(kPeriod));
  Staging staging_{2, kPeriod, 0.06};
};

TEST_F(StagingTest, CommitsOnlyWhatIsDue) {
  stage_many(12);
  staging_.commit(*memory_);
  EXPECT_EQ(memory_->put, 3u);
  EXPECT_EQ(staging_.position().ticks_committed(), 60u);
  EXPECT_EQ(staging_.position().ticks_held(), 240u);
  play(1);
  staging_.commit(*memory_);
  EXPECT_EQ(memory_->put, 4u);
  play(20);
  staging_.commit(*memory_);
  EXPECT_EQ(memory_->put, 4u);
}

TEST_F(StagingTest, SlotHoldsTheBatchWithItsTailAndWhereThatRests) {
  stage_many(4);
  staging_.commit(*memory_);
  const v1::MotionBatch sent = batch(20);
  const kcs_player_batch& slot = memory_->slots[1];
  EXPECT_EQ(slot.run, kNumber);
  EXPECT_EQ(slot.first_tick, 20u);
  EXPECT_EQ(slot.setpoints, 20u);
  EXPECT_EQ(static_cast<int>(slot.tail), sent.tail_mm(0).values_size());
  EXPECT_EQ(slot.position_mm[5][1], sent.position_mm(1).values(5));
  EXPECT_EQ(slot.position_mm[20][0], sent.tail_mm(0).values(0));
  EXPECT_EQ(slot.position_mm[20][2], 0);
  EXPECT_EQ(slot.rest_s, sent.tail_end_s());
  EXPECT_EQ(slot.last, 0u);
}

TEST_F(StagingTest, MarkersComeAtTheirSetpointAndOverdueOnesWithTheFirst) {
  v1::MotionBatch marked = batch(0, 80);
  for (const std::uint64_t tick : {std::uint64_t{0}, std::uint64_t{79}}) {
    v1::MarkerAt& marker = *marked.add_markers();
    marker.set_tick(tick);
    marker.mutable_marker()->set_kind(v1::MARKER_KIND_SPINDLE_CLOCKWISE);
    marker.mutable_marker()->set_value(8000);
  }
  ASSERT_EQ(staging_.stage(marked).staged, Staged::kTaken);
  v1::MotionBatch overdue = batch(80, 20);
  overdue.add_markers()->set_tick(3);
  ASSERT_EQ(staging_.stage(overdue).staged, Staged::kTaken);
  staging_.commit(*memory_);
  play(60);
  staging_.commit(*memory_);
  ASSERT_EQ(memory_->put, 2u);
  EXPECT_EQ(memory_->slots[0].marker_count, 2u);
  EXPECT_EQ(memory_->slots[0].markers[1].setpoint, 79u);
  EXPECT_EQ(memory_->slots[0].markers[1].value, 8000);
  EXPECT_EQ(memory_->slots[1].markers[0].setpoint, 0u);
}

TEST_F(StagingTest, ReplacesWhatItOverlapsAtABatchEnd) {
  stage_many(12);
  staging_.commit(*memory_);
  EXPECT_EQ(stage(100, 50).staged, Staged::kTaken);
  EXPECT_EQ(staging_.position().ticks_held(), 150u);
  EXPECT_EQ(staging_.position().end().plan_time_s(), batch(100, 50).end().plan_time_s());
  EXPECT_EQ(stage(150).staged, Staged::kTaken);
}

TEST_F(StagingTest, RefusesWhatDoesNotBeginAtABatchEnd) {
  stage_many(12);
  const StagingResult result = stage(110);
  EXPECT_EQ(result.staged, Staged::kRefused);
  EXPECT_NE(result.reason.find("no batch's end"), std::string::npos) << result.reason;
  EXPECT_EQ(staging_.position().ticks_held(), 240u);
}

TEST_F(StagingTest, RefusesWhatComesTooLate) {
  stage_many(12);
  staging_.commit(*memory_);
  const StagingResult result = stage(40);
  EXPECT_EQ(result.staged, Staged::kRefused);
  EXPECT_NE(result.reason.find("too late"), std::string::npos) << result.reason;
}

TEST_F(StagingTest, RefusesAGap) {
  stage_many(2);
  const StagingResult result = stage(60);
  EXPECT_EQ(result.staged, Staged::kRefused);
  EXPECT_NE(result.reason.find("the motion held ends at 40"), std::string::npos) << result.reason;
}

TEST_F(StagingTest, HoldsOnlySoManyBatches) {
  for (std::uint64_t i = 0; i < Staging::kMostBatches; ++i) ASSERT_EQ(stage(i, 1).staged, Staged::kTaken);
  const StagingResult result = stage(Staging::kMostBatches, 1);
  EXPECT_EQ(result.staged, Staged::kRefused);
  EXPECT_NE(result.reason.find("too much"), std::string::npos) << result.reason;
}

TEST_F(StagingTest, SameBatchAgainVoidsNothing) {
  stage_many(12);
  EXPECT_EQ(stage(100).staged, Staged::kTaken);
  EXPECT_EQ(staging_.position().ticks_held(), 240u);
}

TEST_F(StagingTest, LeavingTheStreamVoidsWhatIsStaged) {
  stage_many(12);
  staging_.commit(*memory_);
  play(30);
  EXPECT_TRUE(
      staging_.follow({.state = KCS_PLAYER_STOPPING, .run = kNumber, .branch = 1, .played = 45, .rest_s = 3.25}));
  EXPECT_EQ(staging_.stage(batch(60)).staged, Staged::kStale);
  EXPECT_EQ(staging_.stage(batch(45, 20, 1)).staged, Staged::kRefused) << "still moving";
  EXPECT_FALSE(staging_.follow({.state = KCS_PLAYER_HELD, .run = kNumber, .branch = 1, .played = 130, .rest_s = 3.25}));
  const v1::RunPosition position = staging_.position();
  EXPECT_EQ(position.branch(), 1u);
  EXPECT_EQ(position.ticks_played(), 130u);
  EXPECT_EQ(position.ticks_held(), 130u);
  EXPECT_EQ(position.end().plan_time_s(), 3.25);
  EXPECT_EQ(position.end().rate(), 0);
}

TEST_F(StagingTest, GoesOnAfterAStopWithTheNextBranch) {
  stage_many(12);
  staging_.commit(*memory_);
  const kcs_player_report rests = {
      .state = KCS_PLAYER_HELD, .run = kNumber, .branch = 1, .played = 130, .rest_s = 3.25};
  memory_->taken = memory_->put;
  staging_.follow(rests);
  const StraightMotion rest_of_it(3.25, 200, kPeriod);
  for (std::uint64_t first = 0; first < 80; first += 20) {
    ASSERT_EQ(staging_.stage(rest_of_it.batch(kRun, 1, 130 + first, first, 20)).staged, Staged::kTaken);
    staging_.follow(rests);
  }
  staging_.commit(*memory_);
  EXPECT_EQ(memory_->slots[3].first_tick, 130u);
  EXPECT_EQ(memory_->slots[3].branch, 1u);
  EXPECT_EQ(staging_.position().ticks_held(), 210u);
}

// Each entry spoils a sound batch in one way.
struct Damage {
  const char* name;
  const char* told;
  void (*make)(v1::MotionBatch&);
  bool signs = true;  // with a checksum that matches what was made of it
};

class DamagedBatch : public testing::TestWithParam<Damage> {};

TEST_P(DamagedBatch, IsRefusedWithTheReason) {
  v1::MotionBatch batch = StraightMotion(0, 200, kPeriod).batch(kRun, 0, 0, 0, 20);
  ASSERT_EQ(find_damage(batch, 2), std::nullopt);
  GetParam().make(batch);
  if (GetParam().signs) batch.set_checksum(checksum_of(batch));
  const auto damage = find_damage(batch, 2);
  ASSERT_TRUE(damage.has_value());
  EXPECT_NE(damage->find(GetParam().told), std::string::npos) << *damage;
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, DamagedBatch,
    testing::Values(
        Damage{"Bit", "checksum", [](v1::MotionBatch& b) { b.mutable_tail_mm(1)->set_values(3, 7); }, false},
        Damage{"NoSetpoint", "0 setpoints",
               [](v1::MotionBatch& b) {
                 for (auto& column : *b.mutable_position_mm()) column.clear_values();
               }},
        Damage{"MissingAxis", "1 columns for 2 axes",
               [](v1::MotionBatch& b) { b.mutable_position_mm()->RemoveLast(); }},
        Damage{"ShortColumn", "differ in length",
               [](v1::MotionBatch& b) { b.mutable_tail_mm(1)->mutable_values()->RemoveLast(); }},
        Damage{"NoNumber", "no number", [](v1::MotionBatch& b) { b.mutable_position_mm(0)->set_values(4, 0.0 / 0.0); }},
        Damage{"NoClock", "clock", [](v1::MotionBatch& b) { b.set_tail_end_s(1.0 / 0.0); }},
        Damage{"TooLong", "the player takes",
               [](v1::MotionBatch& b) {
                 for (auto& column : *b.mutable_tail_mm()) column.mutable_values()->Resize(5000, 0);
               }},
        Damage{"TailAfterTheEnd", "yet has a stop tail", [](v1::MotionBatch& b) { b.set_end_of_plan(true); }},
        Damage{"MarkerBeyondTheEnd", "beyond its end",
               [](v1::MotionBatch& b) {
                 b.add_markers()->set_tick(20 + static_cast<std::uint64_t>(b.tail_mm(0).values_size()));
               }}),
    [](const auto& kind) { return kind.param.name; });

// Thousands of random batches, commits and ticks: whatever comes, what the player is given is one unbroken row of
// ticks.
TEST_F(StagingTest, GivesThePlayerOneUnbrokenRowOfTicks) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    const auto up_to = [&random](std::uint64_t most) {
      return std::uniform_int_distribution<std::uint64_t>(0, most)(random);
    };
    memory_ = make_player_memory(test_profile(kPeriod));
    staging_.begin(kNumber, 0);
    std::uint64_t next = 0;
    std::uint64_t given = 0;
    std::uint64_t played = 0;
    for (int step = 0; step < 200; ++step) {
      const v1::RunPosition before = staging_.position();
      const std::uint64_t first = up_to(3) > 0
                                      ? before.ticks_held()
                                      : before.ticks_held() + 30 - std::min(before.ticks_held() + 30, up_to(120));
      v1::MotionBatch one = batch(std::min(first, motion_.size() - 1), 1 + up_to(30));
      if (up_to(20) == 0) one.set_checksum(one.checksum() ^ 1U);
      const StagingResult result = staging_.stage(one);
      if (result.staged != Staged::kTaken) {
        EXPECT_FALSE(result.reason.empty());
        EXPECT_EQ(staging_.position().SerializeAsString(), before.SerializeAsString()) << "refused, yet changed";
      }
      staging_.commit(*memory_);
      for (; given < memory_->put; ++given) {
        const kcs_player_batch& slot = memory_->slots[given % KCS_PLAYER_SLOTS];
        ASSERT_EQ(slot.first_tick, next) << "seed " << seed;
        next += slot.setpoints;
      }
      ASSERT_EQ(staging_.position().ticks_committed(), next);
      ASSERT_LE(next - std::min(next, played), 60u + 31u);
      played = std::min(next, played + up_to(25));
      if (played > 0) play(played);
    }
  }
}

}  // namespace
}  // namespace kcs::gateway
