// What is tried again, against a server that is away when it is told to be.
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "client/sdk/error.h"
#include "client/sdk/machines.h"
#include "client/sdk/planner.h"
#include "kcs/v1/machine.grpc.pb.h"
#include "kcs/v1/planning.grpc.pb.h"

namespace kcs::client {
namespace {

const grpc::Status kAway(grpc::StatusCode::UNAVAILABLE, "the store cannot be reached");

// How often each method is UNAVAILABLE before it answers, and how often it was called.
class Troubles {
 public:
  void fail(const std::string& method, int times) { left_[method] = times; }
  grpc::Status next(const std::string& method) {
    const std::lock_guard lock(mutex_);
    ++calls_[method];
    return left_[method]-- > 0 ? kAway : grpc::Status::OK;
  }
  int calls(const std::string& method) {
    const std::lock_guard lock(mutex_);
    return calls_[method];
  }

 private:
  std::mutex mutex_;
  std::map<std::string, int> left_, calls_;
};

constexpr std::uint64_t kSetpoints = 10, kBatch = 2;

class Planning final : public v1::PlanningService::Service {
 public:
  explicit Planning(Troubles& troubles) : troubles_(troubles) {}

  grpc::Status CreatePlan(grpc::ServerContext*, grpc::ServerReader<v1::CreatePlanRequest>* reader,
                          v1::Plan* plan) override {
    v1::CreatePlanRequest request;
    while (reader->Read(&request)) continue;
    plan->set_state(v1::PLAN_STATE_READY);
    return troubles_.next("CreatePlan");
  }
  grpc::Status GetPlan(grpc::ServerContext*, const v1::GetPlanRequest* request, v1::Plan* plan) override {
    plan->set_name(request->name());
    plan->set_state(v1::PLAN_STATE_READY);
    return troubles_.next("GetPlan");
  }
  grpc::Status DeletePlan(grpc::ServerContext*, const v1::DeletePlanRequest*, google::protobuf::Empty*) override {
    return troubles_.next("DeletePlan");
  }
  // Goes away after each second batch of a call.
  grpc::Status StreamSetpoints(grpc::ServerContext*, const v1::StreamSetpointsRequest* request,
                               grpc::ServerWriter<v1::SetpointBatch>* writer) override {
    if (grpc::Status status = troubles_.next("StreamSetpoints"); !status.ok()) return status;
    for (std::uint64_t i = request->first_index(); i < kSetpoints; i += kBatch) {
      if (i == request->first_index() + 2 * kBatch) return kAway;
      v1::SetpointBatch batch;
      batch.set_first_index(i);
      v1::Column& column = *batch.add_position_mm();
      for (std::uint64_t k = 0; k < kBatch; ++k) column.add_values(static_cast<double>(i + k));
      batch.set_setpoint_count(kSetpoints);
      batch.set_end_of_path(i + kBatch == kSetpoints);
      writer->Write(batch);
    }
    return grpc::Status::OK;
  }

 private:
  Troubles& troubles_;
};

class MachineKeeper final : public v1::MachineService::Service {
 public:
  explicit MachineKeeper(Troubles& troubles) : troubles_(troubles) {}

  grpc::Status RunPlan(grpc::ServerContext*, const v1::RunPlanRequest*, v1::Run*) override {
    return troubles_.next("RunPlan");
  }
  grpc::Status ResumeRun(grpc::ServerContext*, const v1::ResumeRunRequest*, v1::Run*) override {
    return troubles_.next("ResumeRun");
  }
  grpc::Status GetRun(grpc::ServerContext*, const v1::GetRunRequest*, v1::Run*) override {
    return troubles_.next("GetRun");
  }

 private:
  Troubles& troubles_;
};

class Retries : public testing::Test {
 protected:
  Retries() {
    grpc::ServerBuilder builder;
    int port = 0;
    builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port);
    builder.RegisterService(&planning_).RegisterService(&keeper_);
    server_ = builder.BuildAndStart();
    // So patient that a busy computer ends no call before its last attempt.
    connection_ = {.address = "127.0.0.1:" + std::to_string(port), .patience = std::chrono::minutes(1)};
  }

  template <typename Call>
  static std::string error_of(const Call& call) {
    try {
      call();
      return "";
    } catch (const Error& error) {
      return error.code();
    }
  }

  Troubles troubles_;
  Planning planning_{troubles_};
  MachineKeeper keeper_{troubles_};
  std::unique_ptr<grpc::Server> server_;
  Connection connection_;
};

TEST_F(Retries, WhatIsSafeIsTriedAgain) {
  Planner planner(connection_);
  Machines machines(connection_);
  troubles_.fail("GetPlan", 2);
  troubles_.fail("CreatePlan", 1);
  troubles_.fail("GetRun", 3);
  EXPECT_EQ(planner.get("plans/x").name, "plans/x");
  EXPECT_EQ(troubles_.calls("GetPlan"), 3);
  PlanOptions options;
  options.machine.velocity_mm_s = options.machine.acceleration_mm_s2 = options.machine.jerk_mm_s3 = {100, 100};
  planner.plan_points({.points_mm = {0, 0, 1, 0}}, options);
  EXPECT_EQ(troubles_.calls("CreatePlan"), 2);
  machines.get("machines/mill/runs/1");
  EXPECT_EQ(troubles_.calls("GetRun"), 4);
}

TEST_F(Retries, AreGivenUpAfterSomeSeconds) {
  Planner planner(connection_);
  troubles_.fail("GetPlan", 1000);
  EXPECT_EQ(error_of([&] { planner.get("plans/x"); }), "UNAVAILABLE");
  EXPECT_EQ(troubles_.calls("GetPlan"), 4);
}

TEST_F(Retries, WhatDeletesOrMovesIsAskedOnce) {
  Planner planner(connection_);
  Machines machines(connection_);
  for (const char* method : {"DeletePlan", "RunPlan", "ResumeRun"}) troubles_.fail(method, 1);
  EXPECT_EQ(error_of([&] { planner.remove("plans/x"); }), "UNAVAILABLE");
  EXPECT_EQ(error_of([&] { machines.run_plan("machines/mill", "plans/x"); }), "UNAVAILABLE");
  EXPECT_EQ(error_of([&] { machines.resume("machines/mill/runs/1"); }), "UNAVAILABLE");
  for (const char* method : {"DeletePlan", "RunPlan", "ResumeRun"}) EXPECT_EQ(troubles_.calls(method), 1) << method;
}

TEST_F(Retries, AStreamGoesOnFromTheNextSetpoint) {
  Planner planner(connection_);
  troubles_.fail("StreamSetpoints", 1);
  SetpointStream stream = planner.stream_setpoints("plans/x", {});
  std::vector<double> values;
  for (SetpointBatch batch; stream.next(batch);) {
    EXPECT_EQ(batch.first_index, values.size());
    values.insert(values.end(), batch.position_mm[0].begin(), batch.position_mm[0].end());
  }
  EXPECT_EQ(values, (std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(troubles_.calls("StreamSetpoints"), 4) << "one that failed, and three that were broken off or ended";
}

TEST_F(Retries, AStreamAtTheMachinesPaceIsBrokenOff) {
  Planner planner(connection_);
  SetpointStream stream = planner.stream_setpoints("plans/x", {.lead_s = 0.1});
  SetpointBatch batch;
  EXPECT_TRUE(stream.next(batch));
  EXPECT_TRUE(stream.next(batch));
  EXPECT_EQ(error_of([&] { stream.next(batch); }), "UNAVAILABLE");
}

}  // namespace
}  // namespace kcs::client
