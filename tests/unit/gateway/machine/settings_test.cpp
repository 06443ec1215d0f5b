#include "client/gateway/machine/settings.h"

#include <gtest/gtest.h>

namespace kcs::gateway {
namespace {

std::string problem(const std::string& text) {
  try {
    parse_settings(text, "gateway.toml");
    return "none";
  } catch (const client::SettingsError& error) {
    return error.what();
  }
}

constexpr const char* kLeast = "[machine]\nname = \"mill\"\n[simulated]\n";

TEST(GatewaySettings, FewAreNeeded) {
  const Settings settings = parse_settings(kLeast, "gateway.toml");
  EXPECT_EQ(settings.machine, "machines/mill");
  EXPECT_EQ(settings.driver, Driver::kSimulated);
  EXPECT_EQ(settings.simulated.profile.axes, 3u);
  EXPECT_EQ(settings.simulated.profile.period_s, 0.001);
  EXPECT_EQ(settings.simulated.start_mm, std::vector<double>(3, 0.0));
  EXPECT_EQ(settings.stream.commit_s, 0.04);
}

TEST(GatewaySettings, ExampleFileHoldsTheDefaults) {
  const Settings example = read_settings(KCS_SOURCE "/deploy/gateway.toml");
  const Settings least = parse_settings(kLeast, "gateway.toml");
  EXPECT_EQ(example.driver, least.driver);
  EXPECT_EQ(example.stream.batch_s, least.stream.batch_s);
  EXPECT_EQ(example.stream.window_s, least.stream.window_s);
  EXPECT_EQ(example.stream.commit_s, least.stream.commit_s);
  EXPECT_EQ(example.stream.report_s, least.stream.report_s);
  EXPECT_EQ(example.simulated.start_mm, least.simulated.start_mm);
  EXPECT_EQ(example.simulated.clock_drift_ppm, least.simulated.clock_drift_ppm);
  EXPECT_EQ(example.simulated.profile.jerk_mm_s3[2], least.simulated.profile.jerk_mm_s3[2]);
  EXPECT_EQ(example.simulated.profile.following_error_mm[0], least.simulated.profile.following_error_mm[0]);
  EXPECT_FALSE(example.server.tls);
}

TEST(GatewaySettings, EveryKeyIsRead) {
  const Settings settings = parse_settings(R"(
[machine]
name = "table-2"
driver = "simulated"
[server]
address = "planner:50551"
tls_ca = "ca.pem"
tls_cert = "mill.pem"
tls_key = "mill.key"
token_file = "token"
[stream]
batch_s = 0.01
window_s = 0.3
commit_s = 0.05
report_s = 0.05
[simulated]
profile = "tajima-sencer-2016"
period_s = 0.0005
following_error_mm = [2, 3]
start_mm = [10, -4]
clock_drift_ppm = -50
switches = "/run/switches"
)",
                                           "gateway.toml");
  EXPECT_EQ(settings.machine, "machines/table-2");
  EXPECT_EQ(settings.server.address, "planner:50551");
  EXPECT_TRUE(settings.server.tls);
  EXPECT_EQ(settings.server.key_file, "mill.key");
  EXPECT_EQ(settings.server.token_file, "token");
  EXPECT_EQ(settings.stream.batch_s, 0.01);
  EXPECT_EQ(settings.stream.commit_s, 0.05);
  EXPECT_EQ(settings.simulated.profile.axes, 2u);
  EXPECT_EQ(settings.simulated.profile.period_s, 0.0005);
  EXPECT_EQ(settings.simulated.profile.following_error_mm[1], 3);
  EXPECT_EQ(settings.simulated.start_mm[1], -4);
  EXPECT_EQ(settings.simulated.clock_drift_ppm, -50);
  EXPECT_EQ(settings.simulated.switches, "/run/switches");
}

TEST(GatewaySettings, HalNeedsOnlyTheComponent) {
  const Settings settings =
      parse_settings("[machine]\nname = \"mill\"\ndriver = \"hal\"\n[hal]\ncomponent = \"table\"\n", "x");
  EXPECT_EQ(settings.driver, Driver::kHal);
  EXPECT_EQ(settings.hal_component, "table");
}

TEST(GatewaySettings, ErrorsSayWhereWhatAndWhatToDo) {
  EXPECT_EQ(problem("[simulated]\n"), "gateway.toml:1:1: machine is missing; add a section [machine]");
  EXPECT_EQ(problem("[machine]\nname = \"a b\"\n"),
            "gateway.toml:2:8: machine.name must be 1 to 63 letters, digits, \"-\" and \"_\"");
  EXPECT_EQ(problem(std::string(kLeast) + "perod_s = 1\n"),
            "gateway.toml:4:1: simulated.perod_s is not a known key; here can be: profile, period_s, "
            "following_error_mm, start_mm, clock_drift_ppm, switches");
  EXPECT_EQ(problem(std::string(kLeast) + "start_mm = [1, 2]\n"),
            "gateway.toml:4:12: simulated.start_mm has 2 entries for 3 axes; give 3 numbers in brackets, one per axis");
  EXPECT_EQ(
      problem(std::string(kLeast) + "[stream]\nbatch_s = 0.005\n"),
      "gateway.toml:4:1: stream.commit_s is more than the player has room for: make it 7 batches (batch_s) at most");
  EXPECT_EQ(problem(std::string(kLeast) + "[stream]\nwindow_s = 0.07\n"),
            "gateway.toml:4:1: stream.window_s is too short: it must hold commit_s and two batches (batch_s) more");
  EXPECT_EQ(problem("[machine]\nname = 3\n"), "gateway.toml:2:8: machine.name is not text; put it in double quotes");
}

TEST(GatewaySettings, FileThatIsNotThereIsNamedWithTheRemedy) {
  EXPECT_THROW(read_settings("/nowhere/gateway.toml"), client::SettingsError);
}

}  // namespace
}  // namespace kcs::gateway
