// CHANNEL_LINE: every setpoint knows the line of the program that moves the tool there.
#include <gtest/gtest.h>

#include <cstdint>
#include <string_view>
#include <vector>

#include "tests/service/test_server.h"

namespace kcs::service::test {
namespace {

using Lines = std::vector<std::uint32_t>;

class LinesOfSetpoints : public ::testing::Test {
 protected:
  // The lines of a plan's setpoints, in their order, each as often as the motion changes to it.
  Lines lines(const std::vector<v1::CreatePlanRequest>& messages) {
    const auto plan = server_.create(messages);
    EXPECT_TRUE(plan.status.ok()) << plan.status.error_message();
    auto asked = setpoints(plan.message.name(), 0.001);
    asked.add_channels(v1::CHANNEL_LINE);
    Lines found;
    for (const v1::SetpointBatch& batch : server_.stream(asked).message) {
      EXPECT_EQ(batch.line_size(), batch.position_mm(0).values_size());
      EXPECT_EQ(batch.segment_size(), 0) << "was not asked for";
      for (const std::uint32_t line : batch.line()) {
        if (found.empty() || found.back() != line) found.push_back(line);
      }
    }
    return found;
  }
  Lines lines(std::string_view program) { return lines({request(options(3)), gcode(program)}); }

  TestServer server_;
};

TEST_F(LinesOfSetpoints, CountWhatDoesNotMoveTheToolToo) {
  EXPECT_EQ(lines("(a part)\n"
                  "\n"
                  "G21 F3000\n"
                  "N900 G1 X10\n"
                  "G4 P0.05\n"
                  "G1 X10\n"
                  "N10 Y10\n"),
            (Lines{4, 7}));
}

TEST_F(LinesOfSetpoints, AreThoseOfTheArcForAllItsChords) {
  EXPECT_EQ(lines("F3000\n"
                  "G1 X20\n"
                  "G3 X20 Y20 J10\n"
                  "G1 X0\n"),
            (Lines{2, 3, 4}));
}

TEST_F(LinesOfSetpoints, GoBackInSubroutinesAndLoops) {
  EXPECT_EQ(lines("F3000\n"
                  "o<tooth> sub\n"
                  "G91 G1 X5 Y5\n"
                  "X5 Y-5\n"
                  "G90\n"
                  "o<tooth> endsub\n"
                  "#1 = 0\n"
                  "o1 while [#1 LT 2]\n"
                  "o<tooth> call\n"
                  "G1 Z[-1-#1]\n"
                  "#1 = [#1+1]\n"
                  "o1 endwhile\n"
                  "G0 Z5\n"),
            (Lines{3, 4, 10, 3, 4, 10, 13}));
}

TEST_F(LinesOfSetpoints, AreThoseOfTheHoleInADrillingCycle) {
  EXPECT_EQ(lines("G0 Z5 F600\n"
                  "G98 G83 X10 Y0 Z-3 R1 Q1\n"
                  "X20\n"
                  "G80\n"
                  "G0 X0\n"),
            (Lines{1, 2, 3, 5}));
}

TEST_F(LinesOfSetpoints, AreThoseThatCameWithThePoints) {
  v1::PathChunk first = path({0, 0, 10, 0, 10, 10}), second = path({20, 10, 20, 20});
  for (const std::uint32_t line : {1U, 4'000'000'000U, 12U}) first.add_line(line);
  EXPECT_EQ(lines({request(options()), request(first), request(second)}), (Lines{4'000'000'000, 12, 0}));
}

TEST_F(LinesOfSetpoints, AreZeroWhereTheToolOnlyWaits) {
  v1::PathChunk chunk = path({1, 1, 1, 1});
  chunk.mutable_stops()->Add()->set_point(1);
  chunk.mutable_stops(0)->set_dwell_s(0.01);
  EXPECT_EQ(lines({request(options()), request(chunk)}), (Lines{0}));
}

}  // namespace
}  // namespace kcs::service::test
