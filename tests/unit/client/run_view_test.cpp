// A run and the machines as people read them, and other programs.
#include "client/cli/run_view.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "client/cli/machine_json.h"
#include "client/cli/machines_table.h"

namespace kcs::cli {
namespace {

using client::MachineState;
using client::Run;
using client::RunState;

Run running() {
  return {.name = "machines/mill/runs/4",
          .plan = "plans/1",
          .state = RunState::kRunning,
          .feed_override_percent = 80,
          .cycle_time_s = 400,
          .plan_time_s = 100,
          .time_left_s = 375,
          .position_mm = {12.3456, -7, 1234.5},
          .feed_mm_s = 80,
          .buffered_s = 0.125,
          .machine_state = MachineState::kRunning};
}

// Without the control sequences that colour it.
std::vector<std::string> plain(const Run& run) {
  std::vector<std::string> lines = run_view(run, 0.25);
  for (std::string& line : lines) {
    for (std::size_t begin; (begin = line.find('\x1b')) != std::string::npos;) {
      line.erase(begin, line.find('m', begin) - begin + 1);
    }
  }
  return lines;
}

TEST(RunView, ShowsAllThatAnOperatorWantsToKnow) {
  EXPECT_EQ(plain(running()), (std::vector<std::string>{
                                  "Run       machines/mill/runs/4",
                                  "State     running  ",
                                  "Position  X     12.346 Y     -7.000 Z   1234.500 mm",
                                  "Feed            4800 mm/min      80.00 mm/s   override  80 %",
                                  "Buffer    [====================                    ]  125 ms",
                                  "Program   [==========                              ]   25 %   0:06:15 left",
                              }));
}

TEST(RunView, NumbersStayInTheirColumns) {
  client::Run other = running();
  other.position_mm = {-1.5, 100, 0};
  other.feed_mm_s = 0.4;
  other.buffered_s = 0.3;  // more than its window: the bar is full
  other.plan_time_s = 399.999;
  other.feed_override_percent = 120;
  const auto lines = plain(running());
  const auto others = plain(other);
  ASSERT_EQ(lines.size(), others.size());
  for (std::size_t i = 0; i < lines.size(); ++i) EXPECT_EQ(lines[i].size(), others[i].size()) << others[i];
  EXPECT_NE(others[5].find(" 99 %"), std::string::npos) << "not 100 before the end";
}

TEST(RunView, AStopSaysWhyAndHowLongItStillTakes) {
  client::Run held = running();
  held.state = RunState::kHeld;
  held.time_left_s = 0;
  held.reason = "no batch was there";
  const auto lines = plain(held);
  EXPECT_EQ(lines[1], "State     held  at rest on the path");
  EXPECT_NE(lines[5].find("0:06:15 left"), std::string::npos) << "300 s at 80 %";
  EXPECT_EQ(lines.back(), "Reason    no batch was there");
  held.feed_override_percent = 0;
  EXPECT_EQ(plain(held)[5].find("left"), std::string::npos) << "nobody knows";
}

TEST(RunView, StatesDifferInColour) {
  client::Run run = running();
  const auto colour = [&run](RunState state) {
    run.state = state;
    const std::string line = run_view(run, 0.25)[1];
    const std::size_t begin = line.find('\x1b');
    return line.substr(begin, line.find('m', begin) - begin);
  };
  EXPECT_NE(colour(RunState::kRunning), colour(RunState::kHeld));
  EXPECT_NE(colour(RunState::kHeld), colour(RunState::kFailed));
  EXPECT_EQ(colour(RunState::kAborted), colour(RunState::kFailed));
}

TEST(RunView, AMachineThatHasGoneHasNoPosition) {
  const client::Run away{.name = "machines/mill/runs/4", .state = RunState::kWaiting, .position_mm = {}};
  const auto lines = plain(away);
  EXPECT_EQ(lines[1], "State     waiting  the machine is not attached");
  EXPECT_EQ(lines[2], "Position  not known");
}

TEST(RunLine, IsTheSameInOneLine) {
  EXPECT_EQ(run_line(running()),
            "machines/mill/runs/4  running  25.0 %  X12.346 Y-7.000 Z1234.500 mm  80.00 mm/s  override 80 %  "
            "buffer 125 ms  0:06:15 left");
  client::Run failed = running();
  failed.state = RunState::kFailed;
  failed.time_left_s = 0;
  failed.reason = "a drive reports a fault";
  EXPECT_TRUE(run_line(failed).ends_with("buffer 125 ms  a drive reports a fault")) << run_line(failed);
}

TEST(RunJson, IsOneLineOfWhatTheServerSays) {
  const std::string text = run_json(running());
  EXPECT_EQ(text.find('\n'), text.size() - 1);
  const auto json = nlohmann::json::parse(text);
  EXPECT_EQ(json["state"], "running");
  EXPECT_EQ(json["plan_time_s"], 100);
  EXPECT_EQ(json["position_mm"].size(), 3);
}

TEST(MachinesTable, HasARowForEachAndSaysWhatIsWrong) {
  const std::vector<client::AttachedMachine> machines = {
      {.name = "machines/mill", .state = MachineState::kReady, .position_mm = {1, 2, 3}, .run = ""},
      {.name = "machines/plotter", .state = MachineState::kFault, .position_mm = {4, 5}, .fault = "a drive failed"}};
  EXPECT_EQ(machines_table(machines),
            "machine               state                X mm       Y mm       Z mm  run\n"
            "machines/mill         ready               1.000      2.000      3.000  -\n"
            "machines/plotter      fault               4.000      5.000             -\n"
            "  a drive failed\n");
  EXPECT_NE(machines_table({}).find("No machine is attached"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(machines_json({machines[1]}))["fault"], "a drive failed");
}

}  // namespace
}  // namespace kcs::cli
