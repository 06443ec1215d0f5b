// Batches that must not be played: each is refused, and the tail of the one before it brings the machine to rest.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "tests/unit/gateway/player/player_at_work.h"

namespace kcs::test {
namespace {

struct Damage {
  std::string name;
  kcs_player_reason reason;
  std::function<void(kcs_player_batch&)> apply;

  friend void PrintTo(const Damage& damage, std::ostream* out) { *out << damage.name; }
};

// Moves the setpoints from `from` on along Y by growing powers of the ticks, each within the limits of lower order.
void bend(kcs_player_batch& batch, std::uint32_t from, double mm, int power) {
  for (std::uint32_t i = from; i < batch.setpoints + batch.tail; ++i) {
    batch.position_mm[i][1] += mm * std::pow(i - from + 1, power);
  }
}

class PlayerRefusal : public testing::TestWithParam<Damage> {
 protected:
  // Running with at most one batch ahead, at a constant pace: well inside the limits of acceleration and jerk.
  PlayerRefusal() {
    work.switch_on();
    work.begin_run(1);
    work.feed(220);
    EXPECT_EQ(work.state(), KCS_PLAYER_RUNNING);
  }

  PlayerAtWork work;
};

TEST_P(PlayerRefusal, PlaysTheTailOfTheBatchBeforeIt) {
  while (work.memory->put - work.memory->taken > 0) work.tick();
  const std::uint64_t refused = work.report().refused;
  auto batch = work.next();
  GetParam().apply(*batch);
  ASSERT_TRUE(work.put(*batch));
  for (int i = 0; i < 3; ++i) work.put_next();  // good ones behind it change nothing
  ASSERT_TRUE(work.tick_until(KCS_PLAYER_STOPPING));
  EXPECT_EQ(work.reason(), GetParam().reason);
  EXPECT_EQ(work.report().refused, refused + 1);
  EXPECT_EQ(work.report().starvations, 0u);
  ASSERT_TRUE(work.tick_until(KCS_PLAYER_HELD));
  EXPECT_LE(work.watch.largest_share(), kAtTheLimit);

  work.resume();
  ASSERT_TRUE(work.feed_until(KCS_PLAYER_RUNNING) && work.feed_until(KCS_PLAYER_READY));
  EXPECT_NEAR(work.place(), work.kLengthMm, 1e-9);
  EXPECT_LE(work.watch.largest_share(), kAtTheLimit);
}

TEST_P(PlayerRefusal, AtRestItJustStaysAtRest) {
  ASSERT_TRUE(work.tick_until(KCS_PLAYER_HELD));
  work.resume();
  auto bad = work.standing(20, 80);
  GetParam().apply(*bad);
  ASSERT_TRUE(work.put(*bad));
  const double place = work.place();
  work.tick(50);
  EXPECT_EQ(work.state(), KCS_PLAYER_HELD);
  EXPECT_EQ(work.reason(), GetParam().reason);
  EXPECT_EQ(work.report().refused, 1u);
  EXPECT_EQ(work.place(), place);
  // The good one may come after it.
  ASSERT_TRUE(work.put_next());
  work.tick(5);
  EXPECT_EQ(work.state(), KCS_PLAYER_RUNNING);
  EXPECT_EQ(work.reason(), KCS_PLAYER_NONE);
}

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

INSTANTIATE_TEST_SUITE_P(
    Damages, PlayerRefusal,
    testing::Values(
        Damage{"a_batch_is_missing", KCS_PLAYER_OUT_OF_ORDER, [](kcs_player_batch& b) { b.first_tick += b.setpoints; }},
        Damage{"a_batch_came_twice", KCS_PLAYER_OUT_OF_ORDER, [](kcs_player_batch& b) { b.first_tick -= b.setpoints; }},
        Damage{"it_has_no_setpoints", KCS_PLAYER_MALFORMED, [](kcs_player_batch& b) { b.setpoints = 0; }},
        Damage{"its_setpoints_exceed_the_slot", KCS_PLAYER_MALFORMED,
               [](kcs_player_batch& b) { b.setpoints = KCS_PLAYER_SETPOINTS + 1; }},
        Damage{"its_tail_exceeds_the_slot", KCS_PLAYER_MALFORMED,
               [](kcs_player_batch& b) { b.tail = KCS_PLAYER_SETPOINTS - b.setpoints + 1; }},
        Damage{"its_counts_wrap_around", KCS_PLAYER_MALFORMED,
               [](kcs_player_batch& b) { b.tail = std::numeric_limits<std::uint32_t>::max() - b.setpoints + 2; }},
        Damage{"it_has_too_many_markers", KCS_PLAYER_MALFORMED,
               [](kcs_player_batch& b) { b.marker_count = KCS_PLAYER_MARKERS + 1; }},
        Damage{"a_marker_lies_beyond_it", KCS_PLAYER_MALFORMED,
               [](kcs_player_batch& b) {
                 b.marker_count = 1;
                 b.markers[0].setpoint = b.setpoints + b.tail;
               }},
        Damage{"a_marker_is_no_number", KCS_PLAYER_MALFORMED,
               [](kcs_player_batch& b) {
                 b.marker_count = 1;
                 b.markers[0].value = kNoNumber;
               }},
        Damage{"it_ends_the_run_with_a_tail", KCS_PLAYER_MALFORMED, [](kcs_player_batch& b) { b.last = 1; }},
        Damage{"its_end_is_neither_yes_nor_no", KCS_PLAYER_MALFORMED, [](kcs_player_batch& b) { b.last = 2; }},
        Damage{"a_position_is_no_number", KCS_PLAYER_MALFORMED,
               [](kcs_player_batch& b) { b.position_mm[7][2] = kNoNumber; }},
        Damage{"a_position_is_infinite", KCS_PLAYER_MALFORMED,
               [](kcs_player_batch& b) { b.position_mm[0][0] = -kInfinite; }},
        Damage{"a_position_of_the_tail_is_no_number", KCS_PLAYER_MALFORMED,
               [](kcs_player_batch& b) { b.position_mm[b.setpoints + 5][0] = kNoNumber; }},
        Damage{"a_position_is_huge", KCS_PLAYER_TOO_FAST, [](kcs_player_batch& b) { b.position_mm[3][0] = 1e300; }},
        Damage{"it_jumps", KCS_PLAYER_TOO_FAST, [](kcs_player_batch& b) { bend(b, 0, 0.5, 0); }},
        Damage{"it_jumps_where_the_tail_begins", KCS_PLAYER_TOO_FAST,
               [](kcs_player_batch& b) { bend(b, b.setpoints, 0.5, 0); }},
        Damage{"it_turns_abruptly", KCS_PLAYER_TOO_STRONG, [](kcs_player_batch& b) { bend(b, 4, 2e-3, 1); }},
        Damage{"it_swerves", KCS_PLAYER_TOO_JERKY, [](kcs_player_batch& b) { bend(b, 4, 4e-5, 2); }},
        Damage{"its_tail_swerves", KCS_PLAYER_TOO_JERKY,
               [](kcs_player_batch& b) { bend(b, b.setpoints + b.tail - 20, -4e-5, 2); }},
        Damage{"its_tail_does_not_come_to_rest", KCS_PLAYER_NOT_AT_REST,
               [](kcs_player_batch& b) { bend(b, b.setpoints + b.tail - 20, 1e-5, 2); }}),
    [](const auto& instance) { return instance.param.name; });

TEST_F(PlayerRefusal, ABatchWithoutATailMustEndAtRest) {
  while (work.memory->put - work.memory->taken > 0) work.tick();
  auto batch = work.next();
  batch->tail = 0;
  work.put(*batch);
  ASSERT_TRUE(work.tick_until(KCS_PLAYER_HELD));
  EXPECT_EQ(work.reason(), KCS_PLAYER_NOT_AT_REST);
  EXPECT_LE(work.watch.largest_share(), kAtTheLimit);
}

TEST_F(PlayerRefusal, TheEndOfTheRunMustBeAtRest) {
  while (work.memory->put - work.memory->taken > 0) work.tick();
  auto batch = work.next();
  batch->tail = 0;
  batch->last = 1;
  work.put(*batch);
  ASSERT_TRUE(work.tick_until(KCS_PLAYER_HELD));
  EXPECT_EQ(work.reason(), KCS_PLAYER_NOT_AT_REST);
  EXPECT_LE(work.watch.largest_share(), kAtTheLimit);
}

// One unit in the last place, back and forth, is more than this jerk would allow.
TEST(PlayerRounding, TheRoundingOfPositionsFarFromZeroIsNoBreach) {
  PlayerAtWork work;
  work.memory->profile.jerk_mm_s3[0] = 1e-4;
  ASSERT_TRUE(kcs_player_start(work.player.get(), work.memory.get()));
  work.switch_on();
  auto batch = work.standing(20, 0);
  for (std::uint32_t i = 0; i < batch->setpoints; i += 2) {
    batch->position_mm[i][0] = std::nextafter(batch->position_mm[i][0], 2000);
  }
  work.put(*batch);
  EXPECT_TRUE(work.tick_until(KCS_PLAYER_RUNNING));
  ASSERT_TRUE(work.tick_until(KCS_PLAYER_HELD));

  batch = work.standing(20, 0);
  batch->position_mm[10][0] += 1e-11;
  work.put(*batch);
  work.tick(50);
  EXPECT_EQ(work.state(), KCS_PLAYER_HELD);
  EXPECT_EQ(work.reason(), KCS_PLAYER_TOO_JERKY);
}

// A gateway that runs wild.
TEST_F(PlayerRefusal, ACountOfBatchesBeyondTheSlotsIsTakenForNone) {
  for (const std::uint64_t put : {work.memory->put + 1000, std::uint64_t{0}, ~std::uint64_t{0}}) {
    work.memory->put = put;
    work.tick(2);
    ASSERT_TRUE(work.tick_until(KCS_PLAYER_HELD));
  }
  EXPECT_LE(work.watch.largest_share(), kAtTheLimit);
}

TEST_F(PlayerRefusal, WritingToWhatWasCheckedChangesNothing) {
  while (work.memory->put - work.memory->taken > 0) work.tick();
  while (work.player->check != KCS_PLAYER_PASSED) work.feed(1);
  for (kcs_player_batch& slot : work.memory->slots) {
    std::fill(&slot.position_mm[0][0], &slot.position_mm[0][0] + KCS_PLAYER_SETPOINTS * KCS_PLAYER_AXES, 1e9);
    slot.setpoints = slot.tail = slot.marker_count = ~std::uint32_t{0};
  }
  work.memory->profile.velocity_mm_s[0] = 1e12;
  ASSERT_TRUE(work.tick_until(KCS_PLAYER_HELD));
  EXPECT_LT(work.place(), work.kLengthMm);
  EXPECT_LE(work.watch.largest_share(), kAtTheLimit);
}

TEST_F(PlayerRefusal, CountsThatChangeWhileABatchIsCheckedAreNotReadAgain) {
  while (work.memory->put - work.memory->taken > 0) work.tick();
  ASSERT_TRUE(work.put_next());
  while (work.player->check != KCS_PLAYER_UNDER_WAY) work.tick();
  for (kcs_player_batch& slot : work.memory->slots) slot.setpoints = slot.tail = ~std::uint32_t{0};
  ASSERT_TRUE(work.tick_until(KCS_PLAYER_HELD));
  EXPECT_EQ(work.report().refused, 0u);
  EXPECT_LE(work.watch.largest_share(), kAtTheLimit);
}

}  // namespace
}  // namespace kcs::test
