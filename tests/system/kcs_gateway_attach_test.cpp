// kcs-gateway attach as a real process, with a server of the test's own.
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/system/child_process.h"
#include "tests/unit/gateway/machine/command_judge.h"
#include "tests/unit/gateway/machine/fake_machine_server.h"

namespace kcs::test {
namespace {

namespace fs = std::filesystem;
using gateway::FakeMachineServer;
using gateway::StraightServer;

constexpr double kLength = 250;  // mm

// The machine of StraightMotion.
constexpr const char* kProfile = R"([machine]
axes = 2
[limits]
velocity_mm_s = [100, 100]
acceleration_mm_s2 = [1000, 1000]
jerk_mm_s3 = [20000, 20000]
)";

class GatewayAttach : public testing::Test {
 protected:
  GatewayAttach() {
    std::string name = (fs::temp_directory_path() / "kcs-attach-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = name;
    write("profile.toml", kProfile);
    write("gateway.toml", "[machine]\nname = \"bench\"\n[simulated]\nprofile = \"" +
                              (folder_ / "profile.toml").string() + "\"\nswitches = \"" + folder_.string() + "\"\n");
  }
  ~GatewayAttach() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }

  std::unique_ptr<ChildProcess> start_gateway() const {
    return std::make_unique<ChildProcess>(
        std::vector<std::string>{KCS_GATEWAY, "attach", "--config", (folder_ / "gateway.toml").string(), "--server",
                                 "127.0.0.1:" + std::to_string(server_.port()), "--record", recording().string()});
  }

  fs::path recording() const { return folder_ / "run.csv"; }

  // What the drives were commanded, to 15 digits.
  std::vector<gateway::Vector> commands() const {
    std::ifstream in(recording());
    std::string line;
    std::getline(in, line);
    std::vector<gateway::Vector> commands;
    while (std::getline(in, line)) {
      std::istringstream row(line);
      char comma = 0;
      double t = 0;
      gateway::Vector command = gateway::Vector::Zero();
      row >> t >> comma >> command.x() >> comma >> command.y();
      commands.push_back(command);
    }
    return commands;
  }

  fs::path folder_;
  StraightServer brain_{"machines/bench/runs/1", kLength, 0.001, 0.25};
  FakeMachineServer server_{brain_};
};

TEST_F(GatewayAttach, PlaysWhatTheServerRunsAndEndsWithItsFiguresOnSigterm) {
  const auto process = start_gateway();
  ASSERT_TRUE(server_.wait_for([](const auto& report) { return report.run_finished(); })) << process->errors();
  process->send_signal(SIGTERM);
  EXPECT_EQ(process->wait(), 0) << process->errors();
  EXPECT_NE(process->errors().find("jitter ticks="), std::string::npos) << process->errors();
  EXPECT_NE(process->errors().find("unrecorded_ticks=0"), std::string::npos) << process->errors();
  EXPECT_EQ(gateway::find_violation(commands(), gateway::test_profile(), kLength), "");
}

TEST_F(GatewayAttach, SigtermInMidMotionComesToRestOnThePathFirst) {
  const auto process = start_gateway();
  ASSERT_TRUE(server_.wait_for([](const auto& report) { return report.run().ticks_played() > 600; }))
      << process->errors();
  process->send_signal(SIGTERM);
  EXPECT_EQ(process->wait(), 0) << process->errors();
  const auto played = commands();
  ASSERT_FALSE(played.empty());
  const double rest = played.back().norm();
  EXPECT_LT(rest, kLength);
  EXPECT_EQ(played.back(), played[played.size() - 2]) << "at rest";
  EXPECT_EQ(gateway::find_violation(played, gateway::test_profile(), rest), "");
}

TEST_F(GatewayAttach, DriveFaultIsToldToTheServer) {
  const auto process = start_gateway();
  ASSERT_TRUE(server_.wait_for([](const auto& report) { return report.run().ticks_played() > 600; }))
      << process->errors();
  write("drive-fault", "");
  EXPECT_TRUE(server_.wait_for([](const auto& report) {
    return report.state() == v1::MACHINE_STATE_FAULT && report.fault().find("drive") != std::string::npos;
  })) << process->errors();
  process->send_signal(SIGTERM);
  EXPECT_EQ(process->wait(), 0) << process->errors();
}

TEST_F(GatewayAttach, SettingsThatAreWrongEndItWithTheirPlace) {
  write("gateway.toml", "[machine]\nname = \"bench\"\n[simulated]\nprofile = 3\n");
  const auto process = start_gateway();
  EXPECT_EQ(process->wait(), 1);
  EXPECT_NE(process->errors().find("gateway.toml:4:11: simulated.profile is not text"), std::string::npos)
      << process->errors();
}

}  // namespace
}  // namespace kcs::test
