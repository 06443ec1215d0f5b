// MachineService: plans run on machines, stop on their path, and go on from there.
#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "server/service/server.h"
#include "server/store/store.h"
#include "tests/files/temporary_folder.h"
#include "tests/observe/figures.h"
#include "tests/service/kept_plans.h"
#include "tests/service/test_gateway.h"
#include "tests/service/test_server.h"

namespace kcs::service::test {
namespace {

motion::AxisLimits limits(double acceleration = 2500) {
  return {.axes = 2,
          .velocity = motion::Vector::Constant(500),
          .acceleration = motion::Vector::Constant(acceleration),
          .jerk = motion::Vector::Constant(2e5)};
}

v1::PlanOptions fitting() {
  v1::PlanOptions fitting = options();
  for (double& velocity : *fitting.mutable_machine()->mutable_velocity_mm_s()) velocity = 500;
  return fitting;
}

class MachineRunsTest : public ::testing::Test {
 protected:
  void SetUp() override { start(); }

  void start(ServerOptions options = {}) {
    server_.emplace(std::move(options));
    stub_ = v1::MachineService::NewStub(server_->channel());
  }

  std::string make_plan(const v1::PathChunk& path = zigzag(30)) { return make_plan(request(path)); }
  std::string make_plan(const v1::CreatePlanRequest& path) {
    const auto plan = server_->create({request(fitting()), path});
    EXPECT_TRUE(plan.status.ok()) << plan.status.error_message();
    cycle_time_ = plan.message.summary().cycle_time_s();
    end_ = {plan.message.summary().end_mm(0), plan.message.summary().end_mm(1), 0};
    return plan.message.name();
  }

  Answer<v1::Run> run(const std::string& plan, std::optional<double> percent = {}) {
    v1::RunPlanRequest request;
    request.set_machine("machines/mill");
    request.set_plan(plan);
    if (percent) request.set_feed_override_percent(*percent);
    return ask(&v1::MachineService::Stub::RunPlan, request);
  }
  Answer<v1::Run> get() { return ask_for<v1::GetRunRequest>(&v1::MachineService::Stub::GetRun); }
  Answer<v1::Run> hold() { return ask_for<v1::HoldRunRequest>(&v1::MachineService::Stub::HoldRun); }
  Answer<v1::Run> resume() { return ask_for<v1::ResumeRunRequest>(&v1::MachineService::Stub::ResumeRun); }
  Answer<v1::Run> abort() { return ask_for<v1::AbortRunRequest>(&v1::MachineService::Stub::AbortRun); }
  Answer<v1::Run> override_feed(double percent) {
    v1::SetFeedOverrideRequest request;
    request.set_name(run_);
    request.set_feed_override_percent(percent);
    return ask(&v1::MachineService::Stub::SetFeedOverride, request);
  }

  // Once the machine is attached, and what was before has gone.
  void begin(const std::string& plan, std::optional<double> percent = {}) {
    Answer<v1::Run> begun;
    ASSERT_TRUE(eventually([&] { return (begun = run(plan, percent)).status.ok(); })) << begun.status.error_message();
    run_ = begun.message.name();
  }
  void expect_state(v1::RunState state) {
    EXPECT_TRUE(eventually([&] { return get().message.state() == state; })) << get().message.ShortDebugString();
  }
  // The path was travelled to its end: the setpoints cover the plan's, in as much time as it needs.
  void expect_at_end() {
    EXPECT_EQ(machine_.drives.position(), end_);
    expect_state(v1::RUN_STATE_FINISHED);
  }

  std::optional<TestServer> server_;
  std::unique_ptr<v1::MachineService::Stub> stub_;
  TestMachine machine_{limits()};
  std::string run_ = "machines/mill/runs/1";
  double cycle_time_ = 0;
  motion::Vector end_ = motion::Vector::Zero();

 private:
  template <typename Request>
  Answer<v1::Run> ask(grpc::Status (v1::MachineService::Stub::*method)(grpc::ClientContext*, const Request&, v1::Run*),
                      const Request& request) {
    Answer<v1::Run> answer;
    Call call;
    answer.status = (*stub_.*method)(&call, request, &answer.message);
    return answer;
  }
  template <typename Request>
  Answer<v1::Run> ask_for(grpc::Status (v1::MachineService::Stub::*method)(grpc::ClientContext*, const Request&,
                                                                           v1::Run*)) {
    Request request;
    request.set_name(run_);
    return ask(method, request);
  }
};

TEST_F(MachineRunsTest, PlayAPlanToItsEnd) {
  const std::string plan = make_plan();
  TestGateway gateway(machine_, server_->channel());
  begin(plan);
  while (gateway.play()) {
  }
  expect_at_end();
  EXPECT_NEAR(static_cast<double>(machine_.played.size()) * 0.001, cycle_time_, 0.1);  // it began from rest
}

TEST_F(MachineRunsTest, StopOnThePathAndGoOnFromThere) {
  const std::string plan = make_plan();
  TestGateway gateway(machine_, server_->channel());
  begin(plan);
  for (int stop = 0; stop < 10; ++stop) {
    for (int i = 0; i < 3 + stop; ++i) ASSERT_TRUE(gateway.play());
    ASSERT_TRUE(hold().status.ok());
    while (gateway.play()) {
    }
    expect_state(v1::RUN_STATE_HELD);
    const auto resumed = resume();
    ASSERT_TRUE(resumed.status.ok()) << resumed.status.error_message();
  }
  while (gateway.play()) {
  }
  expect_at_end();
}

// Every 10 mm the spindle turns a bit faster.
TEST_F(MachineRunsTest, SwitchWhatThePlanSwitchesOnceOverHoldsAndOverrides) {
  constexpr int kSpeeds = 30;
  std::string program = "F6000 G1\nM3 S1\n";
  for (int i = 1; i < kSpeeds; ++i) program += "X" + std::to_string(10 * i) + "\nS" + std::to_string(1 + i) + "\n";
  const std::string plan = make_plan(gcode(program + "X300\nM30\n"));
  TestGateway gateway(machine_, server_->channel());
  begin(plan);
  for (int stop = 0; stop < 6; ++stop) {
    for (int i = 0; i < 3 + stop; ++i) ASSERT_TRUE(gateway.play());
    ASSERT_TRUE(override_feed(stop % 2 == 0 ? 40 : 110).status.ok());
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(gateway.play());
    ASSERT_TRUE(hold().status.ok());
    while (gateway.play()) {
    }
    expect_state(v1::RUN_STATE_HELD);
    ASSERT_TRUE(resume().status.ok());
  }
  while (gateway.play()) {
  }
  expect_at_end();
  ASSERT_EQ(machine_.switched.size(), kSpeeds + 1);
  for (int i = 0; i < kSpeeds; ++i) {
    const v1::MarkerAt& marker = machine_.switched[static_cast<std::size_t>(i)];
    EXPECT_EQ(marker.marker().kind(), v1::MARKER_KIND_SPINDLE_CLOCKWISE);
    EXPECT_EQ(marker.marker().value(), 1 + i);
    ASSERT_LT(marker.tick(), machine_.played.size());
    // With the first setpoint beyond the place: at 100 mm/s and 10 % more a setpoint is no longer than 0.11 mm.
    EXPECT_NEAR(machine_.played[marker.tick()].x(), 10 * i + 0.06, 0.061) << i;
  }
  EXPECT_EQ(machine_.switched.back().marker().kind(), v1::MARKER_KIND_SPINDLE_OFF);
  EXPECT_EQ(machine_.switched.back().tick() + 1, machine_.played.size());
}

TEST_F(MachineRunsTest, StarveOntoTheirPathWhenTheServerIsGone) {
  const kcs::test::TemporaryFolder folder;
  const ServerOptions options{.store = {.database = "sqlite:" + (folder.path() / "plans.db").string()}};
  start(options);
  const std::string plan = make_plan();
  {
    TestGateway gateway(machine_, server_->channel());
    begin(plan);
    for (int i = 0; i < 10; ++i) ASSERT_TRUE(gateway.play());
    server_.reset();
    while (gateway.play()) {
    }
    EXPECT_EQ(machine_.report.state(), v1::MACHINE_STATE_HELD);
  }
  start(options);
  TestGateway gateway(machine_, server_->channel());
  expect_state(v1::RUN_STATE_HELD);
  ASSERT_TRUE(resume().status.ok());
  while (gateway.play()) {
  }
  expect_at_end();
}

TEST_F(MachineRunsTest, GoOnWithoutAStopWhenTheConnectionIsSoonBack) {
  const std::string plan = make_plan();
  auto gateway = std::make_unique<TestGateway>(machine_, server_->channel());
  begin(plan);
  int batches = 0;
  for (int i = 0; i < 5; ++i) {
    for (int k = 0; k < 4; ++k) ASSERT_TRUE(gateway->play()) << ++batches;
    gateway.reset();
    gateway = std::make_unique<TestGateway>(machine_, server_->channel());
  }
  while (gateway->play()) {
  }
  EXPECT_EQ(machine_.report.run().branch(), 0) << "it stopped";
  expect_at_end();
}

// The order to stop may be lost with the connection: what was acknowledged holds all the same.
TEST_F(MachineRunsTest, HoldEvenIfTheConnectionBreaksBeforeTheyAreTold) {
  const std::string plan = make_plan();
  auto gateway = std::make_unique<TestGateway>(machine_, server_->channel());
  begin(plan);
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(gateway->play());
  gateway->deafen();
  ASSERT_TRUE(hold().status.ok());
  gateway.reset();
  gateway = std::make_unique<TestGateway>(machine_, server_->channel());
  while (gateway->play()) {
  }
  expect_state(v1::RUN_STATE_HELD);
  EXPECT_LT(machine_.played.size(), 500) << "it went on with what it held, and no further";
}

// As when a server dies between writing down a run and telling the machine.
TEST_F(MachineRunsTest, ThatNeverCameToTheirMachineAreNoObstacle) {
  const kcs::test::TemporaryFolder folder;
  const ServerOptions options{.store = {.database = "sqlite:" + (folder.path() / "plans.db").string()}};
  start(options);
  const std::string plan = make_plan();
  server_.reset();
  store::Store(options.store).add_run({.machine = "machines/mill", .plan = plan, .controller = ""});
  start(options);
  TestGateway gateway(machine_, server_->channel());
  Answer<v1::Run> aborted;
  ASSERT_TRUE(eventually([&] { return (aborted = abort()).status.error_code() != grpc::StatusCode::NOT_FOUND; }));
  EXPECT_EQ(aborted.message.state(), v1::RUN_STATE_ABORTED) << aborted.status.error_message();
  begin(plan);
  EXPECT_EQ(run_, "machines/mill/runs/2");
  while (gateway.play()) {
  }
  expect_at_end();
}

// A gateway that comes with a run of which nobody knows would be turned away for ever.
TEST_F(MachineRunsTest, ThatNobodyKnowsAreDroppedByTheirMachines) {
  machine_.report.mutable_run()->set_run("machines/mill/runs/77");
  machine_.report.set_state(v1::MACHINE_STATE_HELD);
  TestGateway gateway(machine_, server_->channel());
  EXPECT_FALSE(gateway.play()) << "it is told to stop";
  run_ = "machines/mill/runs/77";
  EXPECT_EQ(get().status.error_code(), grpc::StatusCode::NOT_FOUND);
}

TEST_F(MachineRunsTest, TakeTheirPaceFromTheOverride) {
  const std::string plan = make_plan();
  TestGateway gateway(machine_, server_->channel());
  begin(plan, 50);
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(gateway.play());
  const double percents[] = {25, 100, 3, 150, 200, 0, 80, 100};
  for (const double percent : percents) {
    const auto changed = override_feed(percent);
    ASSERT_TRUE(changed.status.ok()) << changed.status.error_message();
    EXPECT_EQ(changed.message.feed_override_percent(), percent);
    for (int i = 0; i < 8; ++i) ASSERT_TRUE(gateway.play());
  }
  while (gateway.play()) {
  }
  expect_at_end();
}

TEST_F(MachineRunsTest, TakeAnOverrideBeforeWhatIsHeldIsPlayed) {
  const std::string plan = make_plan();
  TestGateway gateway(machine_, server_->channel());
  begin(plan);
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(gateway.play());
  ASSERT_TRUE(override_feed(0).status.ok());
  const std::size_t before = machine_.played.size();
  std::optional<std::size_t> slower;
  double last = 1e9;
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(gateway.play());
  for (std::size_t i = before + 1; i < machine_.played.size(); ++i) {
    const double step = (machine_.played[i] - machine_.played[i - 1]).norm();
    if (!slower && step == 0 && last == 0) slower = i - before;
    last = step;
  }
  ASSERT_TRUE(slower);
  EXPECT_LE(*slower, 200) << "setpoints until it rests";
  EXPECT_EQ(machine_.report.run().branch(), 0) << "it was held";
}

TEST_F(MachineRunsTest, EndWhenTheyAreAborted) {
  const std::string plan = make_plan();
  TestGateway gateway(machine_, server_->channel());
  begin(plan);
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(gateway.play());
  ASSERT_TRUE(abort().status.ok());
  while (gateway.play()) {
  }
  expect_state(v1::RUN_STATE_ABORTED);
  EXPECT_EQ(resume().status.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
}

TEST_F(MachineRunsTest, AreRefusedWithTheReason) {
  const std::string plan = make_plan();
  EXPECT_EQ(run(plan).status.error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(get().status.error_code(), grpc::StatusCode::NOT_FOUND);
  TestMachine weak(limits(1000));
  {
    TestGateway gateway(weak, server_->channel());
    Answer<v1::Run> refused;
    ASSERT_TRUE(eventually([&] { return (refused = run(plan)).status.error_code() != grpc::StatusCode::NOT_FOUND; }));
    EXPECT_EQ(refused.status.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
    EXPECT_NE(refused.status.error_message().find("acceleration of axis X"), std::string::npos);
  }
  ASSERT_TRUE(eventually([&] { return run(plan).status.error_code() == grpc::StatusCode::NOT_FOUND; }));
  TestMachine elsewhere(limits(), {1, 2, 0});
  {
    TestGateway gateway(elsewhere, server_->channel());
    Answer<v1::Run> refused;
    ASSERT_TRUE(eventually([&] { return (refused = run(plan)).status.error_code() != grpc::StatusCode::NOT_FOUND; }));
    EXPECT_NE(refused.status.error_message().find("stands at X1 Y2"), std::string::npos)
        << refused.status.error_message();
    TestMachine second(limits());
    second.hello.set_instance("second");
    EXPECT_EQ(TestGateway(second, server_->channel()).finish().error_code(), grpc::StatusCode::ALREADY_EXISTS);
  }
  ASSERT_TRUE(eventually([&] { return run(plan).status.error_code() == grpc::StatusCode::NOT_FOUND; }));
  TestGateway gateway(machine_, server_->channel());
  EXPECT_TRUE(eventually([&] { return run("plans/none").status.error_code() == grpc::StatusCode::NOT_FOUND; }));
  begin(plan);
  EXPECT_EQ(run(plan).status.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  EXPECT_EQ(resume().status.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  EXPECT_TRUE(refuses_field(override_feed(201).status, "feed_override_percent"));
  EXPECT_TRUE(refuses_field(override_feed(-1).status, "feed_override_percent"));
}

// Each of them finds the machine ready; writing the run to a disk takes a while.
TEST_F(MachineRunsTest, ThatAreAskedForAtTheSameMomentAreNotBegunTwice) {
  const kcs::test::TemporaryFolder folder;
  start({.store = {.database = "sqlite:" + (folder.path() / "plans.db").string()}});
  const std::string plan = make_plan();
  TestGateway gateway(machine_, server_->channel());
  begin(plan);
  for (int round = 0; round < 10; ++round) {
    ASSERT_TRUE(abort().status.ok());
    constexpr int kOperators = 8;
    std::vector<Answer<v1::Run>> answers(kOperators);
    {
      std::vector<std::jthread> operators;
      for (Answer<v1::Run>& answer : answers) operators.emplace_back([&] { answer = run(plan); });
    }
    int begun = 0;
    for (const Answer<v1::Run>& answer : answers) {
      if (answer.status.ok()) {
        ++begun;
        run_ = answer.message.name();
      } else {
        EXPECT_EQ(answer.status.error_code(), grpc::StatusCode::FAILED_PRECONDITION) << answer.status.error_message();
      }
    }
    ASSERT_EQ(begun, 1);
  }
}

TEST_F(MachineRunsTest, AreAbortedWhileTheirMachineTakesThemUp) {
  const kcs::test::TemporaryFolder folder;
  const ServerOptions options{.store = {.database = "sqlite:" + (folder.path() / "plans.db").string()}};
  start(options);
  const std::string plan = make_plan(long_path());
  {
    TestGateway gateway(machine_, server_->channel());
    begin(plan);
    for (int i = 0; i < 10; ++i) ASSERT_TRUE(gateway.play());
    server_.reset();
    while (gateway.play()) {
    }
  }
  start(options);
  TestGateway gateway(machine_, server_->channel());  // the plan is made again for it
  Answer<v1::Run> aborted;
  ASSERT_TRUE(eventually([&] { return (aborted = abort()).status.error_code() != grpc::StatusCode::NOT_FOUND; }));
  EXPECT_EQ(aborted.message.state(), v1::RUN_STATE_ABORTED) << aborted.status.error_message();
  EXPECT_TRUE(gateway.is_told_to_stop());
  EXPECT_EQ(get().message.state(), v1::RUN_STATE_ABORTED);
}

// A machine comes with a run whose plan takes long to be made again.
class MachineThatWaitsForItsPlan : public MachineRunsTest {
 protected:
  void SetUp() override {
    const ServerOptions options{.planning_threads = 1,
                                .store = {.database = "sqlite:" + (folder_.path() / "plans.db").string()}};
    start(options);
    const auto plan = server_->create(join(accept_only(blended()), endless_path()));
    ASSERT_TRUE(plan.status.ok()) << plan.status.error_message();
    plan_ = plan.message.name();
    server_.reset();
    store::Store(options.store).add_run({.machine = "machines/mill", .plan = plan_, .controller = ""});
    machine_.report.mutable_run()->set_run(run_);
    machine_.report.set_state(v1::MACHINE_STATE_HELD);
    start(options);
  }

  void TearDown() override { EXPECT_NE(server_->get(plan_).message.state(), v1::PLAN_STATE_READY) << "too late"; }

  const kcs::test::TemporaryFolder folder_;
  std::string plan_;
};

TEST_F(MachineThatWaitsForItsPlan, IsToldAtOnceToDropARunThatIsAborted) {
  TestGateway gateway(machine_, server_->channel());
  Answer<v1::Run> aborted;
  ASSERT_TRUE(eventually([&] { return (aborted = abort()).status.error_code() != grpc::StatusCode::NOT_FOUND; }));
  EXPECT_EQ(aborted.message.state(), v1::RUN_STATE_ABORTED) << aborted.status.error_message();
  EXPECT_TRUE(gateway.is_told_to_stop());
}

TEST_F(MachineThatWaitsForItsPlan, GetsSignsOfLifeAndOwesThem) {
  TestGateway gateway(machine_, server_->channel());
  EXPECT_GE(gateway.signs_of_life(), 1);
  EXPECT_EQ(gateway.finish().error_code(), grpc::StatusCode::CANCELLED) << "as it was silent";
}

TEST_F(MachineRunsTest, AreAllThatAStoppingServerWaitsForOfAMachine) {
  TestGateway gateway(machine_, server_->channel());
  EXPECT_TRUE(
      eventually([&] { return run("plans/none").status.error_message().find("does not keep") != std::string::npos; }));
  std::thread stopping([&] { server_->server().stop(kDeadline); });
  EXPECT_EQ(gateway.finish().error_code(), grpc::StatusCode::UNAVAILABLE) << "it would have waited for the whole grace";
  stopping.join();
}

TEST_F(MachineRunsTest, AreHeldAndAbortedWhileTheirServerStops) {
  const std::string plan = make_plan();
  TestGateway gateway(machine_, server_->channel());
  begin(plan);
  ASSERT_TRUE(gateway.play());
  std::thread stopping([&] { server_->server().stop(kDeadline); });
  EXPECT_TRUE(eventually([&] { return run(plan).status.error_code() == grpc::StatusCode::UNAVAILABLE; }));
  EXPECT_TRUE(override_feed(50).status.ok());
  const grpc::Status held = hold().status;
  EXPECT_TRUE(held.ok()) << held.error_message();
  while (gateway.play()) {
  }
  expect_state(v1::RUN_STATE_HELD);
  const grpc::Status aborted = abort().status;
  EXPECT_TRUE(aborted.ok()) << aborted.error_message();
  EXPECT_EQ(gateway.finish().error_code(), grpc::StatusCode::UNAVAILABLE) << "it would have waited for the whole grace";
  stopping.join();
}

TEST_F(MachineRunsTest, AreWatchedToTheirEnd) {
  const std::string plan = make_plan();
  TestGateway gateway(machine_, server_->channel());
  begin(plan);
  std::vector<v1::Run> seen;
  std::thread watcher([&] {
    Call call;
    v1::WatchRunRequest request;
    request.set_name(run_);
    const auto reader = stub_->WatchRun(&call, request);
    for (v1::Run run; reader->Read(&run);) seen.push_back(run);
    EXPECT_TRUE(reader->Finish().ok());
  });
  while (gateway.play()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  watcher.join();
  ASSERT_GE(seen.size(), 3);
  EXPECT_EQ(seen.back().state(), v1::RUN_STATE_FINISHED);
  EXPECT_EQ(seen.back().plan_time_s(), seen.back().cycle_time_s());
  for (std::size_t i = 1; i < seen.size(); ++i) EXPECT_GE(seen[i].plan_time_s(), seen[i - 1].plan_time_s() - 1e-9);
}

TEST_F(MachineRunsTest, AreRarelyAskedOfTheStoreWhileTheyAreWatchedAndTheirMachineIsAway) {
  start({.observe = {.http_listen = "127.0.0.1:0"}});
  const auto asked = [this] {
    auto figures = observe::test::read_figures(server_->server().http_address());
    return figures["kcs_store_duration_seconds_count{operation=\"find_run\"}"];
  };
  const std::string plan = make_plan();
  {
    TestGateway gateway(machine_, server_->channel());
    begin(plan);
  }
  ASSERT_TRUE(eventually([&] { return get().status.ok() && asked() > 0; }));
  const double before = asked();
  Call call;
  call.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(1));
  v1::WatchRunRequest request;
  request.set_name(run_);
  const auto reader = stub_->WatchRun(&call, request);
  for (v1::Run run; reader->Read(&run);) {
  }
  EXPECT_EQ(reader->Finish().error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
  EXPECT_GE(asked() - before, 1);
  EXPECT_LE(asked() - before, 5);  // twice a second
}

}  // namespace
}  // namespace kcs::service::test
