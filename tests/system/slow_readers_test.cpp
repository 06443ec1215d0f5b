// What clients that do not read cost a real kcsd.
#include <grpcpp/create_channel.h>
#include <gtest/gtest.h>
#include <kcs/v1/planning.grpc.pb.h>

#include <chrono>
#include <cstdint>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "tests/system/child_process.h"

namespace kcs::test {
namespace {

constexpr int kReaders = 100;
constexpr std::chrono::seconds kDeadline{60};

class SlowReaders : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string greeting = kcsd_.read_line();
    address_ = greeting.substr(greeting.rfind(' ') + 1);
    stub_ = connect();
    grpc::ClientContext call;
    v1::Plan plan;
    const auto writer = stub_->CreatePlan(&call, &plan);
    v1::CreatePlanRequest request;
    request.mutable_options()->mutable_machine()->set_axes(3);
    for (int axis = 0; axis < 3; ++axis) {
      request.mutable_options()->mutable_machine()->add_velocity_mm_s(100);
      request.mutable_options()->mutable_machine()->add_acceleration_mm_s2(1000);
      request.mutable_options()->mutable_machine()->add_jerk_mm_s3(1e5);
    }
    writer->Write(request);
    for (const double number : {0, 0, 0, 1000, 0, 0, 0, 0, 0}) request.mutable_path()->add_points_mm(number);
    request.mutable_path()->add_feed_mm_s(100);
    writer->Write(request);
    writer->WritesDone();
    ASSERT_TRUE(writer->Finish().ok());
    request_.set_name(plan.name());
    request_.set_period_s(1e-5);  // 2 million setpoints
    for (const v1::Channel channel : {v1::CHANNEL_VELOCITY, v1::CHANNEL_ACCELERATION, v1::CHANNEL_JERK,
                                      v1::CHANNEL_PATH_POSITION, v1::CHANNEL_SEGMENT}) {
      request_.add_channels(channel);
    }
  }

  // On a connection of its own.
  std::unique_ptr<v1::PlanningService::Stub> connect() const {
    grpc::ChannelArguments own;
    own.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
    return v1::PlanningService::NewStub(grpc::CreateCustomChannel(address_, grpc::InsecureChannelCredentials(), own));
  }

  // Of the server, bytes.
  std::size_t memory() const {
    std::ifstream file("/proc/" + std::to_string(kcsd_.pid()) + "/status");
    for (std::string word; file >> word;) {
      std::size_t kilobytes = 0;
      if (word == "VmRSS:" && file >> kilobytes) return kilobytes * 1024;
    }
    ADD_FAILURE() << "kcsd is gone: " << kcsd_.errors();
    return 0;
  }

  // Waits until the memory grows no more within a second.
  std::size_t memory_at_rest() const {
    const auto end = std::chrono::steady_clock::now() + kDeadline;
    std::size_t before = memory();
    while (std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::seconds(1));
      const std::size_t now = memory();
      if (now <= before + (64 << 10)) return now;
      before = now;
    }
    ADD_FAILURE() << "the memory grows for a minute";
    return before;
  }

  ChildProcess kcsd_{{KCSD, "--database", "memory", "--listen", "127.0.0.1:0", "--log-level", "off"}};
  std::string address_;
  std::unique_ptr<v1::PlanningService::Stub> stub_;
  v1::StreamSetpointsRequest request_;
};

TEST_F(SlowReaders, CostOneBatchEachAndHoldUpNobody) {
  // A batch of 4096 setpoints with 14 numbers each is 0.45 MB; it is there as a message and as the bytes on their way.
  const std::size_t most = memory_at_rest() + kReaders * (2 << 20);
  std::vector<std::unique_ptr<v1::PlanningService::Stub>> stubs;
  std::vector<std::unique_ptr<grpc::ClientContext>> calls;
  std::vector<std::unique_ptr<grpc::ClientReader<v1::SetpointBatch>>> readers;
  for (int i = 0; i < kReaders; ++i) {
    if (i % 10 == 0) stubs.push_back(connect());
    calls.push_back(std::make_unique<grpc::ClientContext>());
    readers.push_back(stubs.back()->StreamSetpoints(calls.back().get(), request_));
  }
  EXPECT_LT(memory_at_rest(), most);

  // While others are served, however much, it stays so.
  for (int round = 0; round < 3; ++round) {
    grpc::ClientContext call;
    const auto reader = stub_->StreamSetpoints(&call, request_);
    v1::SetpointBatch batch;
    while (reader->Read(&batch)) continue;
    EXPECT_TRUE(reader->Finish().ok());
    EXPECT_TRUE(batch.end_of_path());
  }
  EXPECT_LT(memory_at_rest(), most);

  // They get the rest when they want it.
  v1::SetpointBatch batch;
  for (std::uint64_t next = 0; readers.front()->Read(&batch); next += 4096) ASSERT_EQ(batch.first_index(), next);
  EXPECT_TRUE(readers.front()->Finish().ok());
  EXPECT_TRUE(batch.end_of_path());
  for (int i = 1; i < kReaders; ++i) calls[static_cast<std::size_t>(i)]->TryCancel();
  for (int i = 1; i < kReaders; ++i) EXPECT_FALSE(readers[static_cast<std::size_t>(i)]->Finish().ok());
}

}  // namespace
}  // namespace kcs::test
