// kcs-gateway with the driver "hal": what HAL's own sampler saw is the judge.
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>
#include <random>
#include <stdexcept>
#include <thread>

#include "tests/system/hal_machine.h"
#include "tests/unit/gateway/machine/command_judge.h"
#include "tests/unit/gateway/machine/fake_machine_server.h"

namespace kcs::test {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

constexpr double kLength = 600;  // mm: 6 s without a stop

class HalGateway : public testing::Test {
 protected:
  void SetUp() override {
    if (const auto missing = HalMachine::missing()) GTEST_SKIP() << *missing;
    std::string name = "/tmp/kcs-hal-gateway-XXXXXX";
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = name;
    fs::permissions(folder_, fs::perms::all);
    // Where HAL's user may read it.
    fs::copy_file(KCS_GATEWAY, folder_ / "kcs-gateway");
    std::ofstream(folder_ / "gateway.toml")
        << "[machine]\nname = \"bench\"\ndriver = \"hal\"\n[hal]\ncomponent = \"simulation\"\n";
    machine_.emplace();
  }
  ~HalGateway() override { fs::remove_all(folder_); }

  ChildProcess start_gateway() const {
    return machine_->start({(folder_ / "kcs-gateway").string(), "attach", "--config",
                            (folder_ / "gateway.toml").string(), "--server",
                            "127.0.0.1:" + std::to_string(server_.port())});
  }

  std::vector<gateway::Vector> commands() {
    std::this_thread::sleep_for(milliseconds(500));  // for the last of the motion to get through the sampler
    std::vector<gateway::Vector> commands;
    std::optional<unsigned long> before;
    for (const HalSample& sample : machine_->record()) {
      EXPECT_TRUE(!before || sample.tick == *before + 1)
          << "from tick " << before.value_or(0) << " to " << sample.tick << ": samples are lost, the record is void";
      before = sample.tick;
      commands.emplace_back(sample.command_mm[0], sample.command_mm[1], sample.command_mm[2]);
    }
    return commands;
  }

  fs::path folder_;
  std::optional<HalMachine> machine_;
  gateway::StraightServer brain_{"machines/bench/runs/1", kLength, 0.001, 0.25, 3};
  gateway::FakeMachineServer server_{brain_};
};

TEST_F(HalGateway, PlaysARunToItsEnd) {
  ChildProcess gateway = start_gateway();
  ASSERT_TRUE(server_.wait_for([](const auto& report) { return report.run_finished(); })) << gateway.errors();
  gateway.send_signal(SIGTERM);
  EXPECT_EQ(gateway.wait(), 0) << gateway.errors();
  EXPECT_EQ(gateway::find_violation(commands(), gateway::test_profile(), kLength), "");
}

TEST_F(HalGateway, KilledAtRandomItLeavesTheMachineOnThePathAndTheNextOneGoesOn) {
  std::mt19937 random(11);
  int kills = 0;
  const auto finished = [&] {
    return server_.wait_for([](const auto& report) { return report.run_finished(); },
                            milliseconds(std::uniform_int_distribution<int>(300, 1200)(random)));
  };
  for (bool over = false; !over;) {
    ChildProcess gateway = start_gateway();
    over = finished();
    gateway.send_signal(SIGKILL);
    gateway.wait();
    kills += over ? 0 : 1;
    ASSERT_LT(kills, 100) << "does not get on: " << gateway.errors();
  }
  EXPECT_GT(kills, 5);
  EXPECT_EQ(gateway::find_violation(commands(), gateway::test_profile(), kLength), "");
}

}  // namespace
}  // namespace kcs::test
