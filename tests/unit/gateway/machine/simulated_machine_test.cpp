#include "client/gateway/machine/simulated_machine.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <chrono>
#include <fstream>
#include <stdexcept>

#include "client/gateway/machine/player_memory.h"
#include "tests/unit/gateway/machine/straight_motion.h"

namespace kcs::gateway {
namespace {

namespace fs = std::filesystem;

class SimulatedMachineTest : public testing::Test {
 protected:
  SimulatedMachineTest() {
    std::string name = (fs::temp_directory_path() / "kcs-switches-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = name;
    switches_ = std::make_unique<Switches>(folder_);
    machine_ = std::make_unique<SimulatedMachine>(*memory_, Vector(10, -0.3, 0), 0, *switches_, trace_);
  }
  ~SimulatedMachineTest() override {
    machine_.reset();
    switches_.reset();
    fs::remove_all(folder_);
  }

  void turn_on(const char* name) { std::ofstream(folder_ / name) << "on"; }
  void turn_off(const char* name) { fs::remove(folder_ / name); }

  kcs_player_report report() const {
    kcs_player_report report{};
    while (!kcs_player_read(memory_.get(), &report)) {
    }
    return report;
  }
  bool wait_for(kcs_player_state state) const {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (report().state != state && std::chrono::steady_clock::now() < deadline) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return report().state == state;
  }

  fs::path folder_;
  PlayerMemory memory_ = make_player_memory(test_profile());
  Trace trace_{65'536};
  std::unique_ptr<Switches> switches_;
  std::unique_ptr<SimulatedMachine> machine_;
};

TEST_F(SimulatedMachineTest, StandsExactlyWhereItWasPutWhenTheDrivesComeOn) {
  ASSERT_TRUE(wait_for(KCS_PLAYER_READY));
  EXPECT_EQ(report().command_mm[0], 10);
  EXPECT_EQ(report().command_mm[1], -0.3);
}

TEST_F(SimulatedMachineTest, DriveFaultIsLatchedUntilItIsSwitchedOffAndOn) {
  ASSERT_TRUE(wait_for(KCS_PLAYER_READY));
  turn_on("drive-fault");
  ASSERT_TRUE(wait_for(KCS_PLAYER_FAULT));
  EXPECT_EQ(report().reason, static_cast<std::uint32_t>(KCS_PLAYER_DRIVE_FAULT));
  turn_off("drive-fault");
  turn_on("off");
  ASSERT_TRUE(wait_for(KCS_PLAYER_OFF));
  turn_off("off");
  EXPECT_TRUE(wait_for(KCS_PLAYER_READY));
}

TEST_F(SimulatedMachineTest, StuckSlidesEndInAFollowingError) {
  ASSERT_TRUE(wait_for(KCS_PLAYER_READY));
  turn_on("stuck");
  while (!switches_->is_on(Switches::kStuck)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const StraightMotion motion(0, 200, 0.001);
  kcs_player_batch* slot = kcs_player_free_slot(memory_.get());
  ASSERT_NE(slot, nullptr);
  // From where it stands, 6 mm along X: more than the 5 mm that are allowed.
  const v1::MotionBatch batch = motion.batch("", 0, 0, 0, 200);
  *slot = {.run = 1, .setpoints = 200, .tail = static_cast<std::uint32_t>(batch.tail_mm(0).values_size())};
  for (int i = 0; i < 200 + static_cast<int>(slot->tail); ++i) {
    const double x = i < 200 ? batch.position_mm(0).values(i) : batch.tail_mm(0).values(i - 200);
    slot->position_mm[i][0] = 10 + x;
    slot->position_mm[i][1] = -0.3;
  }
  kcs_player_put(memory_.get());
  ASSERT_TRUE(wait_for(KCS_PLAYER_FAULT));
  EXPECT_EQ(report().reason, static_cast<std::uint32_t>(KCS_PLAYER_FOLLOWING_ERROR));
}

TEST(SimulatedMachine, FollowsTheClockOfItsDrives) {
  const PlayerMemory memory = make_player_memory(test_profile());
  Trace trace(65'536);
  const Switches switches("");
  SimulatedMachine machine(*memory, Vector::Zero(), 400, switches, trace);
  std::this_thread::sleep_for(std::chrono::seconds(3));
  const ClockFigures figures = machine.finish();
  EXPECT_GT(figures.out_of_step_us, 0);
  EXPECT_LT(figures.out_of_step_us, 100) << "3 s without following would be 1200 µs";
}

TEST(SimulatedMachine, LimitsThatAreNotSoundAreRefused) {
  kcs_player_profile profile = test_profile();
  profile.jerk_mm_s3[1] = 0;
  const PlayerMemory memory = make_player_memory(profile);
  Trace trace(16);
  const Switches switches("");
  EXPECT_THROW(SimulatedMachine(*memory, Vector::Zero(), 0, switches, trace), std::invalid_argument);
}

}  // namespace
}  // namespace kcs::gateway
