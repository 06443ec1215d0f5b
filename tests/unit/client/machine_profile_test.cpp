#include "client/sdk/machine_profile.h"

#include <gtest/gtest.h>

#include <string>

namespace kcs::client {
namespace {

constexpr const char* kGood = R"([machine]
name = "mill"
axes = 2
[limits]
velocity_mm_s = [100, 200.5]
acceleration_mm_s2 = [1000, 2000]
jerk_mm_s3 = [1e4, 2e4]
rapid_mm_s = 150
)";

std::string with(std::string text, const std::string& old, const std::string& replacement) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return text.replace(at, old.size(), replacement);
}

std::string error_of(const std::string& text) {
  try {
    parse_machine_profile(text, "mill.toml");
  } catch (const ProfileError& error) {
    return error.what();
  }
  return "no error";
}

TEST(MachineProfile, ReadsEveryField) {
  const Machine machine = parse_machine_profile(kGood, "mill.toml");
  EXPECT_EQ(machine.name, "mill");
  EXPECT_EQ(machine.axes, 2);
  EXPECT_EQ(machine.velocity_mm_s, (std::vector<double>{100, 200.5}));
  EXPECT_EQ(machine.acceleration_mm_s2, (std::vector<double>{1000, 2000}));
  EXPECT_EQ(machine.jerk_mm_s3, (std::vector<double>{1e4, 2e4}));
  EXPECT_EQ(machine.rapid_mm_s, 150);
}

TEST(MachineProfile, NameAndRapidMayBeLeftOut) {
  const Machine machine =
      parse_machine_profile(with(with(kGood, "name = \"mill\"\n", ""), "rapid_mm_s = 150\n", ""), "");
  EXPECT_EQ(machine.name, "");
  EXPECT_FALSE(machine.rapid_mm_s.has_value());
}

TEST(MachineProfile, ErrorsNamePlaceKeyAndRemedy) {
  EXPECT_EQ(error_of(with(kGood, "axes = 2", "axes = 4")),
            "mill.toml:3:8: machine.axes must be 2 (X, Y) or 3 (X, Y, Z)");
  EXPECT_EQ(error_of(with(kGood, "[1000, 2000]", "[1000]")),
            "mill.toml:6:22: limits.acceleration_mm_s2 has 1 entries for 2 axes; give 2 numbers in brackets, one per "
            "axis");
  EXPECT_EQ(error_of(with(kGood, "[1e4, 2e4]", "[1e4, -1]")),
            "mill.toml:7:20: limits.jerk_mm_s3[1] must be a number greater than 0");
  EXPECT_EQ(error_of(with(kGood, "[1e4, 2e4]", "[1e4, \"fast\"]")),
            "mill.toml:7:20: limits.jerk_mm_s3[1] must be a number greater than 0");
  EXPECT_EQ(error_of(with(kGood, "[1e4, 2e4]", "[1e4, inf]")),
            "mill.toml:7:20: limits.jerk_mm_s3[1] must be a number greater than 0");
  EXPECT_EQ(error_of(with(kGood, "[1e4, 2e4]", "1e4")),
            "mill.toml:7:14: limits.jerk_mm_s3 is not an array; give 2 numbers in brackets, one per axis");
  EXPECT_EQ(error_of(with(kGood, "\"mill\"", "7")), "mill.toml:2:8: machine.name is not text; put it in double quotes");
}

TEST(MachineProfile, MissingKeysAreNamed) {
  EXPECT_EQ(error_of(with(kGood, "axes = 2\n", "")),
            "mill.toml:1:1: machine.axes is missing; add axes = 2 (X, Y) or axes = 3 (X, Y, Z)");
  EXPECT_EQ(error_of(with(kGood, "jerk_mm_s3 = [1e4, 2e4]\n", "")),
            "mill.toml:4:1: limits.jerk_mm_s3 is missing; give 2 numbers in brackets, one per axis");
  EXPECT_EQ(error_of("[machine]\naxes = 2\n"), "mill.toml:1:1: limits is missing; add a section [limits]");
}

TEST(MachineProfile, UnknownKeysAreRefused) {
  EXPECT_EQ(error_of(with(kGood, "rapid_mm_s", "rapids_mm_s")),
            "mill.toml:8:1: limits.rapids_mm_s is not a known key; here can be: velocity_mm_s, acceleration_mm_s2, "
            "jerk_mm_s3, rapid_mm_s");
  EXPECT_EQ(error_of(std::string(kGood) + "[spindle]\n"),
            "mill.toml:9:2: spindle is not a known key; here can be: machine, limits");
}

TEST(MachineProfile, BrokenTomlIsRefusedWithItsPlace) {
  EXPECT_EQ(error_of("[machine]\naxes = = 2\n").rfind("mill.toml:2:8: not valid TOML: ", 0), 0)
      << error_of("[machine]\naxes = = 2\n");
}

TEST(MachineProfile, MissingFileIsNamed) {
  try {
    read_machine_profile("/nowhere/mill.toml");
    FAIL();
  } catch (const ProfileError& error) {
    EXPECT_STREQ(error.what(),
                 "/nowhere/mill.toml: cannot be read; check its name and permissions, or name a built-in profile");
  }
}

TEST(MachineProfile, ShippedProfilesAreTheFilesInDeploy) {
  ASSERT_EQ(shipped_profiles().size(), 3);
  for (const ShippedProfile& profile : shipped_profiles()) {
    const Machine built_in = find_machine(std::string(profile.name));
    const Machine file = find_machine(std::string(KCS_MACHINES) + "/" + std::string(profile.name) + ".toml");
    EXPECT_EQ(built_in.name, file.name);
    EXPECT_EQ(built_in.jerk_mm_s3, file.jerk_mm_s3);
  }
}

}  // namespace
}  // namespace kcs::client
