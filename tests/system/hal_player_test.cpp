// The player as a component of LinuxCNC's HAL, with a feeder that dies: what HAL's own sampler saw is the judge.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <random>
#include <thread>

#include "tests/line_motion/limit_watch.h"
#include "tests/line_motion/line_motion.h"
#include "tests/system/hal_machine.h"

namespace kcs::test {
namespace {

using std::chrono::milliseconds;

class HalPlayer : public testing::Test {
 protected:
  void SetUp() override {
    if (const auto missing = HalMachine::missing()) GTEST_SKIP() << *missing;
    machine_.emplace();
  }

  // What every record must show: each period once, the line, forward, at the limits or below, no step at any time.
  void judge(const std::vector<HalSample>& samples, double length_mm) const {
    ASSERT_GT(samples.size(), 1000u);
    LimitWatch watch(line_.profile(LineLimits{}, 1e-3));
    double place = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const HalSample& sample = samples[i];
      ASSERT_EQ(sample.tick, samples[0].tick + i) << "the sampler lost samples, the record is void";
      watch.see(sample.command_mm);
      ASSERT_LE(watch.largest_share(), 1 + 1e-5) << "tick " << sample.tick;
      ASSERT_LT(line_.distance_to(sample.command_mm), 1e-9);
      ASSERT_GE(line_.place_of(sample.command_mm), place - 1e-9);
      place = line_.place_of(sample.command_mm);
    }
    EXPECT_NEAR(place, length_mm, 1e-9);
    EXPECT_GT(watch.largest_share(), 0.99) << "the motion was to go to the limits";
  }

  // How often the record shows a tail to rest.
  static int stops(const std::vector<HalSample>& samples) {
    int count = 0;
    for (std::size_t i = 1; i < samples.size(); ++i) {
      if (samples[i].state == KCS_PLAYER_HELD && samples[i - 1].state == KCS_PLAYER_STOPPING) ++count;
    }
    return count;
  }

  Line line_;
  std::optional<HalMachine> machine_;
};

TEST_F(HalPlayer, AFeederThatIsKilledLeavesTheMachineOnItsPathAndAtRest) {
  constexpr double kLength = 3000;  // twice what the killed ones get done
  constexpr int kKills = 30;
  std::mt19937 random(7);
  for (int i = 0; i < kKills; ++i) {
    ChildProcess feeder = machine_->feeder(kLength);
    ASSERT_EQ(feeder.read_line(), "feeding") << feeder.errors();
    std::this_thread::sleep_for(milliseconds(std::uniform_int_distribution<int>(0, 300)(random)));
    feeder.send_signal(SIGKILL);
    ASSERT_EQ(feeder.wait(), -SIGKILL);
  }
  ChildProcess last = machine_->feeder(kLength);
  EXPECT_EQ(last.read_line(), "feeding");
  EXPECT_EQ(last.read_line(), "end");
  const std::vector<HalSample> samples = machine_->record();
  judge(samples, kLength);
  EXPECT_GE(stops(samples), kKills) << "more where a feeder starved on a busy computer";
}

TEST_F(HalPlayer, TheHoldInputStopsOnThePathAndLetsGoOn) {
  constexpr double kLength = 300;
  ChildProcess feeder = machine_->feeder(kLength);
  ASSERT_EQ(feeder.read_line(), "feeding");
  for (int i = 0; i < 4; ++i) {
    std::this_thread::sleep_for(milliseconds(150));
    machine_->command({"setp", "kcs-player.hold", "1"});
    std::this_thread::sleep_for(milliseconds(300));
    machine_->command({"setp", "kcs-player.hold", "0"});
  }
  EXPECT_EQ(feeder.read_line(), "end");
  const std::vector<HalSample> samples = machine_->record();
  judge(samples, kLength);
  EXPECT_GT(stops(samples), 0);
}

TEST_F(HalPlayer, ItsMemoryIsForItsGroupAndGoesWithIt) {
  const std::filesystem::path memory = machine_->file("/dev/shm/kcs-simulation");
  using std::filesystem::perms;
  EXPECT_EQ(std::filesystem::status(memory).permissions(),
            perms::owner_read | perms::owner_write | perms::group_read | perms::group_write);
  machine_->command({"delf", "kcs-player.tick", "servo-thread"});
  machine_->command({"unloadrt", "kcs_player"});
  EXPECT_FALSE(std::filesystem::exists(memory));
}

}  // namespace
}  // namespace kcs::test
