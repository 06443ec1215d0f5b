// The reader beside LinuxCNC's interpreter, on the programs that come with LinuxCNC.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string_view>

#include "tests/rs274/comparison.h"
#include "tests/rs274/reference.h"
#include "tests/unit/gcode/program.h"

namespace kcs::test {
namespace {

// Why kcs refuses programs that LinuxCNC reads, in the words of the refusals.
constexpr std::array<std::string_view, 4> kReasons = {
    "cutter compensation is not supported", "splines are not supported", "cycles of turning are not supported",
    "cannot follow the spindle"};
constexpr std::size_t kFewest = 15;  // programs that must be left to compare

std::string contents(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Why a program is left out; empty if it is to be compared. Then it is in `program`.
std::string why_left_out(const std::string& file, const Reference& reference, gcode::Program& program) {
  if (reference.moves.empty()) return "nothing moves";
  if (!reference.obstacle.empty()) return reference.obstacle;
  try {
    program = gcode::read_program(contents(file));
  } catch (const planning::InvalidInput& refusal) {
    const std::string reason = refusal.what();
    const bool is_known = std::any_of(kReasons.begin(), kReasons.end(),
                                      [&](std::string_view known) { return reason.find(known) != std::string::npos; });
    EXPECT_TRUE(is_known) << file << " is refused: " << reason;
    return "refused: " + reason;
  }
  return {};
}

TEST(LinuxCncPrograms, AreReadAsLinuxCncReadsThem) {
  if (const std::string reason = why_no_reference(); !reason.empty()) GTEST_SKIP() << reason;
  std::size_t compared = 0;
  for (const std::string& file : programs_of_linuxcnc()) {
    const Reference reference = reference_of(file);
    gcode::Program program;
    const std::string reason = why_left_out(file, reference, program);
    if (reason.empty()) {
      ++compared;
      EXPECT_EQ(difference(program.path, reference.moves), "") << file;
      std::printf("compared  %s: %zu moves\n", file.c_str(), reference.moves.size());
    } else {
      std::printf("left out  %s: %s\n", file.c_str(), reason.c_str());
    }
  }
  EXPECT_GE(compared, kFewest);
}

}  // namespace
}  // namespace kcs::test
