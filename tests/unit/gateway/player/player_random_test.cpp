// Whatever comes in whatever order, what goes to the drives is inside the limits and on the line.
#include <gtest/gtest.h>

#include <random>

#include "tests/unit/gateway/player/player_at_work.h"

namespace kcs::test {
namespace {

constexpr int kRuns = 1000;  // for each of 20 seeds
constexpr int kEventsOfARun = 8;

class RandomWork {
 public:
  explicit RandomWork(unsigned seed) : random_(seed) {}

  // Things happen to a run, good and bad; then it is given what it needs, to its end.
  void go_through_a_run(std::uint64_t number) {
    begin(number);
    for (int i = 0; i < kEventsOfARun; ++i) {
      happen();
      const int ticks = below(60);
      for (int tick = 0; tick < ticks; ++tick) this->tick();
    }
    finish();
  }

  int times_stopped_for(kcs_player_reason reason) const { return stopped_[reason]; }

 private:
  int below(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }

  // A short way with every run, back to the beginning of the line with every other one.
  void begin(std::uint64_t number) {
    if (work_.place() > 500) {
      work_.input.enable = false;
      work_.tick();
      std::copy(work_.line.origin.begin(), work_.line.origin.end(), work_.input.actual_mm);
      work_.tick();
      work_.watch_again();
    }
    if (!work_.input.enable) work_.switch_on();
    work_.run = LineRun(work_.line, work_.limits, work_.kPeriodS, 1 + below(40), work_.place() + 5 + below(10));
    work_.begin_run(number);
    slow_ = below(4) == 0;
  }

  void tick() {
    if (!slow_ && work_.memory->put - work_.memory->taken < 2) work_.put_next();
    const std::uint64_t played = work_.report().played;
    const std::uint64_t run = work_.report().run;
    const double place = work_.place();
    const kcs_player_state before = work_.state();
    work_.tick();
    // One setpoint a tick, forward, and none while it rests.
    const bool moves = work_.state() == KCS_PLAYER_RUNNING || work_.state() == KCS_PLAYER_STOPPING;
    if (work_.report().run == run) {
      ASSERT_EQ(work_.report().played, played + (moves ? 1 : 0));
    } else {
      ASSERT_EQ(work_.report().played, 1u);
    }
    ASSERT_GE(work_.place(), place - 1e-9);
    if (!moves) {
      ASSERT_EQ(work_.place(), place);
    }
    ASSERT_LT(work_.line.distance_to(work_.output.command_mm), 1e-9);
    ASSERT_LE(work_.watch.largest_share(), kAtTheLimit);
    if (work_.state() != before && !moves) ++stopped_[work_.reason()];
  }

  void happen() {
    switch (below(8)) {
      case 0:
        kcs_player_ask_to_stop(work_.memory.get());
        break;
      case 1:
        work_.input.hold = !work_.input.hold;
        break;
      case 2:
        slow_ = !slow_;
        break;
      case 3:
        if (!work_.run.over()) work_.next();
        break;  // one is lost
      case 4:
        put_damaged();
        break;
      case 5:
        put_stale();
        break;
      default:
        if (work_.state() == KCS_PLAYER_HELD) work_.resume();
        break;
    }
  }

  void put_damaged() {
    if (work_.run.over()) return;
    auto batch = work_.next();
    const std::uint32_t at = static_cast<std::uint32_t>(below(static_cast<int>(batch->setpoints + batch->tail)));
    double& value = batch->position_mm[at][below(3)];
    switch (below(6)) {
      case 0:
        value += 1;
        break;
      case 1:
        value += 1e-3;
        break;
      case 2:
        value = -value;
        break;
      case 3:
        batch->tail = static_cast<std::uint32_t>(below(static_cast<int>(batch->tail) + 1));
        break;
      case 4:
        value += 0.02;
        break;
      default:
        batch->setpoints += static_cast<std::uint32_t>(below(10000));
        break;
    }
    work_.put(*batch);
  }

  void put_stale() {
    auto batch = std::make_unique<kcs_player_batch>();
    batch->run = work_.report().run + (below(2) ? 1 : 0);
    batch->branch = static_cast<std::uint64_t>(below(3));
    batch->first_tick = static_cast<std::uint64_t>(below(300));
    batch->setpoints = 1;
    std::copy(std::begin(work_.output.command_mm), std::end(work_.output.command_mm), batch->position_mm[0]);
    work_.put(*batch);
  }

  void finish() {
    work_.input.hold = false;
    slow_ = false;
    for (int i = 0; i < 100'000 && !testing::Test::HasFatalFailure(); ++i) {
      if (work_.state() == KCS_PLAYER_READY) return;
      tick();
      if (work_.state() == KCS_PLAYER_HELD && work_.memory->put == work_.memory->taken &&
          work_.player->check == KCS_PLAYER_UNSEEN) {
        work_.resume();
      }
    }
    FAIL() << "the run did not come to its end";
  }

  std::mt19937 random_;
  PlayerAtWork work_;
  bool slow_ = false;
  int stopped_[KCS_PLAYER_SWITCHED_OFF + 1] = {};
};

class PlayerRandom : public testing::TestWithParam<unsigned> {};

TEST_P(PlayerRandom, NeverBreaksALimitNorRepeatsNorSkipsATick) {
  RandomWork random(GetParam());
  for (std::uint64_t run = 1; run <= kRuns; ++run) {
    random.go_through_a_run(run);
    ASSERT_FALSE(HasFatalFailure()) << "run " << run;
  }
  for (const auto reason :
       {KCS_PLAYER_END, KCS_PLAYER_ASKED, KCS_PLAYER_STARVED, KCS_PLAYER_OUT_OF_ORDER, KCS_PLAYER_MALFORMED,
        KCS_PLAYER_TOO_FAST, KCS_PLAYER_TOO_STRONG, KCS_PLAYER_TOO_JERKY, KCS_PLAYER_NOT_AT_REST}) {
    EXPECT_GT(random.times_stopped_for(reason), 0) << "reason " << reason;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, PlayerRandom, testing::Range(1u, 21u));

}  // namespace
}  // namespace kcs::test
