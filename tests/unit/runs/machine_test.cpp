// What a machine is told when its gateway attaches while something else happens, and what its reports mean.
#include "server/runs/machine.h"

#include <gtest/gtest.h>

#include <memory>
#include <variant>
#include <vector>

#include "server/planning/plan_path.h"

namespace kcs::runs {
namespace {

MachineProfile profile() {
  MachineProfile profile{.name = "machines/mill"};
  profile.limits.axes = 2;
  profile.limits.velocity = {100, 100, 0};
  profile.limits.acceleration = {1000, 1000, 0};
  profile.limits.jerk = {1e5, 1e5, 0};
  return profile;
}

jobs::PlanPointer make_plan() {
  auto kept = std::make_shared<jobs::KeptPlan>();
  kept->options.planning.limits = profile().limits;
  planning::Toolpath path;
  path.segments.push_back({.end = {10, 0, 0}, .feed = 100, .tolerance = 0.01});
  kept->plan = planning::plan(path, kept->options.planning);
  return kept;
}

bool is_told_to_drop_its_run(Machine& machine) {
  while (const auto order = machine.next_order({})) {
    const auto* stop = std::get_if<StopOrder>(&*order);
    if (stop && stop->abort) return true;
  }
  return false;
}

class MachineTest : public testing::Test {
 protected:
  MachineTest() { machine_.attach({.state = MachineState::kReady, .run = "machines/mill/runs/1"}); }
  Machine machine_{profile()};
};

TEST_F(MachineTest, DropsARunThatIsOver) {
  machine_.drop_run();
  EXPECT_TRUE(is_told_to_drop_its_run(machine_));
}

// A client can ask for the next run after the gateway has attached, and before it is known that the last one is over.
TEST_F(MachineTest, DropsNotTheRunThatBeganMeanwhile) {
  machine_.begin({.name = "machines/mill/runs/2", .plan = "plans/x"}, make_plan());
  machine_.drop_run();
  EXPECT_FALSE(is_told_to_drop_its_run(machine_));
}

TEST_F(MachineTest, FailsARunThatItsGatewayCannotBegin) {
  machine_.begin({.name = "machines/mill/runs/2", .plan = "plans/x"}, make_plan());
  machine_.report({.state = MachineState::kReady,
                   .run = "machines/mill/runs/2",
                   .where = {.ends = {BatchEnd{}}},
                   .fault = "the machine moves"});
  EXPECT_EQ(machine_.run()->state, RunState::kFailed);
  EXPECT_EQ(machine_.run()->reason, "the machine moves");
}

}  // namespace
}  // namespace kcs::runs
