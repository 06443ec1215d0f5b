// What a machine is told when its gateway attaches while something else happens, and what its reports mean.
#include "server/runs/machine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
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

std::vector<Order> orders_for(Machine& machine) {
  std::vector<Order> orders;
  while (auto order = machine.next_order({})) orders.push_back(*std::move(order));
  return orders;
}

bool is_stop(const Order& order, bool abort) {
  const auto* stop = std::get_if<StopOrder>(&order);
  return stop && stop->abort == abort;
}

bool is_told_to_drop_its_run(Machine& machine) {
  const std::vector<Order> orders = orders_for(machine);
  return std::any_of(orders.begin(), orders.end(), [](const Order& order) { return is_stop(order, true); });
}

class MachineTest : public testing::Test {
 protected:
  MachineTest() { machine_.attach({.state = MachineState::kReady, .run = "machines/mill/runs/1"}); }
  // Begins it before its gateway has heard of it, if it ever does.
  void begin_second() { machine_.begin({.name = "machines/mill/runs/2", .plan = "plans/x"}, make_plan()); }
  void report_second(MachineState state) {
    machine_.report({.state = state, .run = "machines/mill/runs/2", .where = {.ends = {BatchEnd{}}}});
  }
  Machine machine_{profile()};
};

TEST_F(MachineTest, DropsARunThatIsOver) {
  machine_.drop_run();
  EXPECT_TRUE(is_told_to_drop_its_run(machine_));
}

// A client can ask for the next run after the gateway has attached, and before it is known that the last one is over.
TEST_F(MachineTest, DropsNotTheRunThatBeganMeanwhile) {
  begin_second();
  machine_.drop_run();
  EXPECT_FALSE(is_told_to_drop_its_run(machine_));
}

TEST_F(MachineTest, FailsARunThatItsGatewayCannotBegin) {
  begin_second();
  machine_.report({.state = MachineState::kReady,
                   .run = "machines/mill/runs/2",
                   .where = {.ends = {BatchEnd{}}},
                   .fault = "the machine moves"});
  EXPECT_EQ(machine_.run()->state, RunState::kFailed);
  EXPECT_EQ(machine_.run()->reason, "the machine moves");
}

// The connection was dead, and nobody had noticed it: nothing of the run has come to the gateway.
TEST_F(MachineTest, HoldsARunThatItsGatewayHearsOfOnlyWhenItAttachesAnew) {
  begin_second();
  ASSERT_EQ(machine_.hold("machines/mill/runs/2").state, RunState::kHeld);
  orders_for(machine_);  // are lost
  machine_.attach({.state = MachineState::kReady});
  EXPECT_EQ(machine_.run()->state, RunState::kHeld);
  const std::vector<Order> orders = orders_for(machine_);
  ASSERT_EQ(orders.size(), 2);
  EXPECT_TRUE(std::holds_alternative<StartOrder>(orders[0]));
  EXPECT_TRUE(is_stop(orders[1], false));

  report_second(MachineState::kHeld);
  EXPECT_EQ(machine_.run()->state, RunState::kHeld);
  machine_.resume("machines/mill/runs/2");
  const std::vector<Order> further = orders_for(machine_);
  ASSERT_GE(further.size(), 2);
  EXPECT_TRUE(std::holds_alternative<ResumeOrder>(further[0]));
  EXPECT_TRUE(std::holds_alternative<BatchOrder>(further[1]));
}

// It stands somewhere on the path, and would go through the whole program once more.
TEST_F(MachineTest, BeginsNoRunAnewThatItsGatewayHasForgotten) {
  begin_second();
  report_second(MachineState::kRunning);
  machine_.attach({.state = MachineState::kReady});
  EXPECT_EQ(machine_.run()->state, RunState::kFailed);
  EXPECT_NE(machine_.run()->reason.find("started anew"), std::string::npos) << machine_.run()->reason;
  EXPECT_TRUE(orders_for(machine_).empty());
}

TEST_F(MachineTest, HasAbortedARunThatItsGatewayHasForgottenSince) {
  begin_second();
  report_second(MachineState::kRunning);
  machine_.abort("machines/mill/runs/2");
  orders_for(machine_);  // are lost
  machine_.attach({.state = MachineState::kReady});
  EXPECT_EQ(machine_.run()->state, RunState::kAborted);
  EXPECT_TRUE(orders_for(machine_).empty());
}

// Its plan may have taken long to be made again.
TEST_F(MachineTest, TakesUpNoRunThatItsGatewayHasForgottenMeanwhile) {
  machine_.report({.state = MachineState::kReady});
  machine_.take_up({.name = "machines/mill/runs/1", .plan = "plans/x"}, make_plan());
  EXPECT_EQ(machine_.run()->state, RunState::kFailed);
  EXPECT_TRUE(orders_for(machine_).empty());
}

// It rests by itself, or has not begun yet, before the order to drop the run is on its way: the run would be kept.
TEST_F(MachineTest, IsToldToDropARunThatIsAbortedWhileItComesToRest) {
  for (const MachineState rests : {MachineState::kHeld, MachineState::kReady}) {
    begin_second();
    report_second(rests == MachineState::kHeld ? MachineState::kRunning : MachineState::kReady);
    machine_.abort("machines/mill/runs/2");
    report_second(rests);
    EXPECT_EQ(machine_.run()->state, RunState::kAborted);
    EXPECT_TRUE(is_told_to_drop_its_run(machine_));
  }
}

TEST_F(MachineTest, IsToldToDropTheLastRunBeforeItBeginsTheNext) {
  begin_second();
  report_second(MachineState::kReady);
  machine_.abort("machines/mill/runs/2");
  report_second(MachineState::kReady);
  machine_.begin({.name = "machines/mill/runs/3", .plan = "plans/x"}, make_plan());
  const std::vector<Order> orders = orders_for(machine_);
  ASSERT_GE(orders.size(), 2);
  EXPECT_TRUE(is_stop(orders[0], true));
  EXPECT_TRUE(std::holds_alternative<StartOrder>(orders[1]));
}

}  // namespace
}  // namespace kcs::runs
