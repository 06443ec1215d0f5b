// The client library's way to machines, against a real server and the gateway of a machine that plays what it is sent.
#include "client/sdk/machines.h"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "client/sdk/planner.h"
#include "server/service/server.h"
#include "tests/rpc/eventually.h"
#include "tests/service/test_gateway.h"

namespace kcs::client {
namespace {

using kcs::test::eventually;
using service::test::TestGateway;
using service::test::TestMachine;

motion::AxisLimits limits() {
  return {.axes = 2,
          .velocity = motion::Vector::Constant(500),
          .acceleration = motion::Vector::Constant(2500),
          .jerk = motion::Vector::Constant(2e5)};
}

class MachinesTest : public testing::Test {
 protected:
  static service::ServerOptions server_options() {
    service::ServerOptions options;
    options.store.database = "memory";
    options.listen = "127.0.0.1:0";
    options.planning_threads = 1;
    options.caps.cached_plans = 1;
    return options;
  }

  void TearDown() override {
    player_.request_stop();
    server_.stop(std::chrono::milliseconds(0));  // or the gateway would wait for more to play
  }

  AttachedMachine attached() {
    std::vector<AttachedMachine> machines;
    EXPECT_TRUE(eventually([&] { return !(machines = machines_.list()).empty(); }));
    return machines.at(0);
  }

  // A plan of this many mm, made for the machine as it is attached.
  std::string plan(double length = 100) { return plan_points({0, 0, length, 0, length, 50}); }
  std::string plan_points(const std::vector<double>& points) {
    PlanOptions options;
    options.machine = attached().limits;
    options.feed_mm_s = 100;
    return Planner(server_.address()).plan_points({.points_mm = points}, options).name;
  }

  // Stands still, and says so until the test ends.
  void rest() {
    player_ = std::jthread([this] { gateway_.finish(); });
  }
  // Plays on, resumes included, until the test ends.
  void play_on() {
    player_ = std::jthread([this](const std::stop_token& stop) {
      while (!stop.stop_requested()) {
        if (machine_.report.run_finished()) return;
        gateway_.play();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    });
  }

  RunState state(const std::string& run) { return machines_.get(run).state; }

  service::Server server_{server_options()};
  Machines machines_{Connection{.address = server_.address()}};
  TestMachine machine_{limits()};
  TestGateway gateway_{machine_, grpc::CreateChannel(server_.address(), grpc::InsecureChannelCredentials())};
  std::jthread player_;
};

std::string code_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.code();
  }
  return "no error";
}

TEST_F(MachinesTest, AreListedWithWhatAPlanForThemNeeds) {
  const AttachedMachine machine = attached();
  EXPECT_EQ(machine.name, "machines/mill");
  EXPECT_EQ(machine.limits.axes, 2);
  EXPECT_EQ(machine.limits.jerk_mm_s3, (std::vector<double>{2e5, 2e5}));
  EXPECT_EQ(machine.state, MachineState::kReady);
  EXPECT_EQ(machine.position_mm, (std::vector<double>{0, 0}));
  EXPECT_EQ(machine.period_s, 0.001);
  EXPECT_EQ(machine.window_s, 0.25);
  EXPECT_EQ(machine.run, "");
}

TEST_F(MachinesTest, RunAPlanThatIsWatchedToItsEnd) {
  const std::string name = plan();
  const client::Run run = machines_.run_plan("machines/mill", name, 150);
  EXPECT_EQ(run.plan, name);
  EXPECT_EQ(run.feed_override_percent, 150);
  EXPECT_GT(run.cycle_time_s, 1);
  EXPECT_EQ(attached().run, run.name);
  play_on();
  double time = 0;
  int changes = 0;
  const client::Run last = machines_.watch(run.name, [&](const client::Run& now) {
    EXPECT_GE(now.plan_time_s, time - 1e-9);
    time = now.plan_time_s;
    ++changes;
  });
  EXPECT_EQ(last.state, RunState::kFinished);
  EXPECT_EQ(last.plan_time_s, last.cycle_time_s);
  EXPECT_EQ(last.position_mm, (std::vector<double>{100, 50}));
  EXPECT_GE(changes, 2);
}

TEST_F(MachinesTest, RunAPlanThatTakesLongToBeMadeAgain) {
  rest();
  std::vector<double> zigzag;
  for (int i = 0; i < 12'000; ++i) zigzag.insert(zigzag.end(), {0.1 * i, static_cast<double>(i % 2)});
  const std::string name = plan_points(zigzag);
  plan();  // takes its place in memory
  Machines impatient(Connection{.address = server_.address(), .patience = std::chrono::milliseconds(200)});
  ASSERT_TRUE(eventually([&] { return code_of([&] { impatient.list(); }) == "no error"; }));
  EXPECT_EQ(impatient.run_plan("machines/mill", name).plan, name);
}

TEST_F(MachinesTest, HoldResumeChangeThePaceAndAbort) {
  const std::string run = machines_.run_plan("machines/mill", plan(100'000)).name;
  play_on();
  ASSERT_TRUE(eventually([&] { return state(run) == RunState::kRunning; }));
  machines_.hold(run);
  ASSERT_TRUE(eventually([&] { return state(run) == RunState::kHeld; }));
  EXPECT_EQ(code_of([&] { machines_.run_plan("machines/mill", "plans/none"); }), "NOT_FOUND");
  machines_.resume(run);
  ASSERT_TRUE(eventually([&] { return state(run) == RunState::kRunning; }));
  EXPECT_EQ(machines_.set_feed_override(run, 30).feed_override_percent, 30);
  EXPECT_EQ(code_of([&] { machines_.resume(run); }), "FAILED_PRECONDITION");
  machines_.abort(run);
  EXPECT_TRUE(eventually([&] { return state(run) == RunState::kAborted; }));
}

TEST_F(MachinesTest, WatchingEndsWhenItIsStoppedAndTheRunGoesOn) {
  const std::string run = machines_.run_plan("machines/mill", plan(100'000)).name;
  play_on();
  std::stop_source stop;
  EXPECT_EQ(code_of([&] {
              machines_.watch(
                  run, [&](const client::Run&) { stop.request_stop(); }, stop.get_token());
            }),
            "CANCELLED");
  struct Enough {};
  EXPECT_THROW(machines_.watch(run, [](const client::Run&) { throw Enough(); }), Enough);
  EXPECT_FALSE(is_over(state(run)));
}

TEST_F(MachinesTest, RefusalsCarryCodeAndReason) {
  EXPECT_EQ(code_of([&] { machines_.get("machines/mill/runs/77"); }), "NOT_FOUND");
  EXPECT_EQ(code_of([&] { machines_.run_plan("machines/none", "plans/none"); }), "NOT_FOUND");
  const std::string run = machines_.run_plan("machines/mill", plan()).name;
  try {
    machines_.set_feed_override(run, 201);
    FAIL();
  } catch (const Error& error) {
    ASSERT_EQ(error.violations().size(), 1);
    EXPECT_EQ(error.violations()[0].field, "feed_override_percent");
  }
  Machines nobody(Connection{.address = "unix:/nobody/listens/here"});
  EXPECT_EQ(code_of([&] { nobody.list(); }), "UNAVAILABLE");
}

}  // namespace
}  // namespace kcs::client
