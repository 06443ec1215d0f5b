// The judge of the faults: that it lets good motion pass, and nothing else.
#include "tests/faults/judge.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/faults/program.h"

namespace kcs::faults {
namespace {

constexpr double kPeriod = 0.001;

class JudgeTest : public testing::Test {
 protected:
  JudgeTest() {
    const Program program = sharp_program();
    ProgramCursor cursor(program, 50);
    runs_.push_back({.plan = make_plan(cursor.next()), .begun = 0, .complete = true});
    const motion::Trajectory& trajectory = runs_[0].plan.trajectory;
    auto phase = trajectory.begin();
    for (double time = 0; time < trajectory.duration(); time = static_cast<double>(commands_.size()) * kPeriod) {
      phase.seek(time);
      commands_.push_back({phase->at(std::min(time - phase->start_time, phase->duration)).position, time});
    }
    const motion::Vector end = trajectory.final_state().position;
    for (int i = 0; i < 3; ++i) commands_.push_back({end, static_cast<double>(commands_.size()) * kPeriod});
  }

  std::string fault() const { return judge(commands_, runs_, machine_limits(), kPeriod).fault; }

  Runs runs_;
  Commands commands_;
};

TEST_F(JudgeTest, ThePlannedMotionPasses) { EXPECT_EQ(fault(), ""); }

TEST_F(JudgeTest, OnePointOffTheCurveIsSeen) {
  commands_[300].position[2] += 1e-6;
  EXPECT_NE(fault().find("tick 300: "), std::string::npos) << fault();
}

TEST_F(JudgeTest, APartLeftOutIsSeen) {
  commands_.erase(commands_.begin() + 200, commands_.begin() + 230);
  EXPECT_NE(fault().find("tick 200: "), std::string::npos) << fault();
}

TEST_F(JudgeTest, MotionThatIsBrokenOffIsSeen) {
  commands_.resize(300);
  EXPECT_NE(fault().find("does not end at rest"), std::string::npos) << fault();
}

TEST_F(JudgeTest, ARunThatEndsTooSoonIsSeen) {
  commands_.resize(1);
  EXPECT_NE(fault().find("not at the end of the path"), std::string::npos) << fault();
}

}  // namespace
}  // namespace kcs::faults
