#include "server/motion/program_lines.h"

#include <gtest/gtest.h>

#include <vector>

namespace kcs::motion {
namespace {

ProgramLines lines_of(const std::vector<std::uint32_t>& lines) {
  ProgramLines made;
  for (const std::uint32_t line : lines) made.add(line);
  return made;
}

TEST(ProgramLines, KnowTheLineOfEachSegment) {
  const std::vector<std::uint32_t> expected = {3, 3, 0, 7, 14, 20, 19, 18, 3, 4'294'967'295, 0, 1};
  const ProgramLines lines = lines_of(expected);
  for (std::uint32_t segment = 0; segment < expected.size(); ++segment) {
    EXPECT_EQ(lines.of(segment), expected[segment]) << segment;
  }
}

TEST(ProgramLines, OfAPathWithoutSegmentsAreNotKnown) { EXPECT_EQ(ProgramLines().of(0), 0U); }

TEST(ProgramLines, TakeNoMoreMemoryWhileTheyAreEvenlySpaced) {
  ProgramLines arc, curve, scattered;
  for (std::uint32_t segment = 0; segment < 1000; ++segment) {
    arc.add(5);
    curve.add(1 + segment);
    scattered.add(1 + segment * segment);
  }
  EXPECT_EQ(arc.bytes(), 12U);
  EXPECT_EQ(curve.bytes(), 12U);
  EXPECT_EQ(scattered.bytes(), 6U * 1000);
}

TEST(ProgramLines, ForgetOnlyWhatIsNotNeeded) {
  ProgramLines lines = lines_of({1, 1, 2, 2, 7});
  lines.forget_before(1);
  EXPECT_EQ(lines.of(1), 1U);
  lines.forget_before(3);
  EXPECT_EQ(lines.of(3), 2U);
  EXPECT_EQ(lines.bytes(), 2 * 12U);
  lines.forget_before(5);
  lines.add(7);
  lines.add(4);
  EXPECT_EQ(lines.of(5), 7U);
  EXPECT_EQ(lines.of(6), 4U);
}

}  // namespace
}  // namespace kcs::motion
