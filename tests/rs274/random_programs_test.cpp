// The reader beside LinuxCNC's interpreter, on programs by chance.
#include <gtest/gtest.h>

#include "tests/files/temporary_folder.h"
#include "tests/rs274/comparison.h"
#include "tests/rs274/random_program.h"
#include "tests/rs274/reference.h"
#include "tests/unit/gcode/program.h"

namespace kcs::test {
namespace {

constexpr std::uint32_t kPrograms = 100;

TEST(RandomPrograms, AreReadAsLinuxCncReadsThem) {
  if (const std::string reason = why_no_reference(); !reason.empty()) GTEST_SKIP() << reason;
  const TemporaryFolder folder;
  std::uint32_t compared = 0;
  for (std::uint32_t seed = 1; seed <= kPrograms; ++seed) {
    const std::string text = random_program(seed);
    const Reference reference = reference_of(folder.write("random.ngc", text));
    const std::string refusal = gcode::refusal_of(text);
    ASSERT_EQ(refusal.empty(), reference.obstacle.empty()) << "seed " << seed << "\n" << text << refusal;
    if (!refusal.empty()) continue;
    ++compared;
    ASSERT_EQ(difference(gcode::read_program(text).path, reference.moves), "") << "seed " << seed << "\n" << text;
  }
  EXPECT_GE(compared, kPrograms / 2);
}

}  // namespace
}  // namespace kcs::test
