#include "client/gateway/recording.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

namespace kcs::gateway {
namespace {

std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::filesystem::path temporary_file(const std::string& name) {
  return std::filesystem::path(testing::TempDir()) / (std::to_string(getpid()) + "-" + name);
}

TEST(Recording, WritesCommandedAndActualPositionOfEachTick) {
  const auto file = temporary_file("three-axes.csv");
  Recording recording(file, 3, 0.0005);
  recording.add({.commanded_mm = Vector(1, 2, 3), .actual_mm = Vector(1.0007125, -2, 0), .clock_s = 12.25});
  recording.add({.commanded_mm = Vector(0.1, 0, 0), .actual_mm = Vector(0, 0, 1.0 / 3), .clock_s = 12.2505});
  recording.finish();
  EXPECT_EQ(contents(file),
            "t,x,y,z,actual_x,actual_y,actual_z,clock\n"
            "0,1,2,3,1.0007125,-2,0,12.250000\n"
            "0.0005,0.1,0,0,0,0,0.333333333333333,12.250500\n");
  std::filesystem::remove(file);
}

TEST(Recording, MachinesWithTwoAxesHaveNoZ) {
  const auto file = temporary_file("two-axes.csv");
  Recording recording(file, 2, 0.001);
  recording.add({.commanded_mm = Vector(1, 2, 0), .actual_mm = Vector(1, 2, 0)});
  recording.finish();
  EXPECT_EQ(contents(file), "t,x,y,actual_x,actual_y,clock\n0,1,2,1,2,0.000000\n");
  std::filesystem::remove(file);
}

TEST(Recording, AFileThatCannotBeWrittenIsNamed) {
  try {
    const Recording recording("/nowhere/at/all.csv", 2, 0.001);
    FAIL() << "opened";
  } catch (const std::system_error& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/at/all.csv"), std::string::npos) << error.what();
  }
}

TEST(Recording, AFullDiskIsAnError) {
  Recording recording("/dev/full", 2, 0.001);
  recording.add({});
  EXPECT_THROW(recording.finish(), std::system_error);
}

}  // namespace
}  // namespace kcs::gateway
