// StreamSetpoints at the pace of the machine: when batches come, and how a stream ends that waits for the next one.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>
#include <vector>

#include "tests/service/test_server.h"

namespace kcs::service::test {
namespace {

using Clock = std::chrono::steady_clock;

// A stream that waits waits this long, s; that it ended long before that is certain on any machine.
constexpr double kWait = 50;
constexpr std::chrono::seconds kSoon{20};

class PacedSetpoints : public ::testing::Test {
 protected:
  explicit PacedSetpoints(ServerOptions options = {}) : server_(std::move(options)) {}

  void SetUp() override {
    // Rests for ten waits on the way.
    v1::PathChunk chunk = path({0, 0, 10, 0, 10, 10});
    v1::Stop& stop = *chunk.add_stops();
    stop.set_point(1);
    stop.set_dwell_s(10 * kWait);
    const auto plan = server_.create({request(options()), request(chunk)});
    ASSERT_TRUE(plan.status.ok()) << plan.status.error_message();
    name_ = plan.message.name();
  }

  v1::StreamSetpointsRequest paced(double period, double lead) const {
    auto request = setpoints(name_, period);
    request.set_lead_s(lead);
    return request;
  }

  // One setpoint a batch, and nothing after the first one for kWait.
  v1::StreamSetpointsRequest waiting() const {
    auto request = paced(kWait / 5, 0);
    request.set_batch_size(5);
    return request;
  }

  TestServer server_;
  std::string name_;
};

TEST_F(PacedSetpoints, ComeNoSoonerThanTheirLead) {
  auto request = paced(0.01, 0.1);
  request.set_first_index(7);
  request.set_last_index(60);
  request.set_batch_size(3);
  Call call;
  const auto began = Clock::now();
  const auto reader = server_.stub().StreamSetpoints(&call, request);
  std::uint64_t batches = 0;
  for (v1::SetpointBatch batch; reader->Read(&batch); ++batches) {
    const std::chrono::duration<double> passed = Clock::now() - began;
    EXPECT_GE(passed.count(), 0.01 * static_cast<double>(batch.first_index() - 7) - 0.1);
  }
  EXPECT_TRUE(reader->Finish().ok());
  EXPECT_EQ(batches, 18U);
}

TEST_F(PacedSetpoints, BatchesHoldATenthOfASecondUnlessToldOtherwise) {
  for (const auto& [period, size] : {std::pair{0.001, 100}, {0.004, 25}, {0.5, 1}, {1e-5, 4096}}) {
    auto request = paced(period, 3600);
    request.set_last_index(5000);
    EXPECT_EQ(server_.stream(request).message.front().position_mm(0).values_size(), size) << period;
  }
}

TEST_F(PacedSetpoints, AreTheSameAsWithoutAPace) {
  auto request = setpoints(name_, 0.001);
  request.set_last_index(500);
  const auto expected = column(server_.stream(request).message, 0);
  request.set_lead_s(0.2);
  EXPECT_EQ(column(server_.stream(request).message, 0), expected);
}

TEST_F(PacedSetpoints, EndAtOnceWhenTheServerStops) {
  Call call;
  const auto reader = server_.stub().StreamSetpoints(&call, waiting());
  v1::SetpointBatch batch;
  ASSERT_TRUE(reader->Read(&batch));
  const auto began = Clock::now();
  std::jthread stopping([this] { server_.server().stop(std::chrono::milliseconds(10)); });
  EXPECT_FALSE(reader->Read(&batch));
  EXPECT_EQ(reader->Finish().error_code(), grpc::StatusCode::UNAVAILABLE);
  EXPECT_LT(Clock::now() - began, kSoon);
}

// With room for one stream only.
class OnePacedStream : public PacedSetpoints {
 protected:
  OnePacedStream() : PacedSetpoints({.caps = {.streams = 1}}) {}
};

TEST_F(OnePacedStream, EndsSoonWhenItsClientGivesUp) {
  Call call;
  const auto reader = server_.stub().StreamSetpoints(&call, waiting());
  v1::SetpointBatch batch;
  ASSERT_TRUE(reader->Read(&batch));
  EXPECT_EQ(server_.stream(setpoints(name_, 10)).status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  const auto began = Clock::now();
  call.TryCancel();
  EXPECT_TRUE(eventually([this] { return server_.stream(setpoints(name_, 10)).status.ok(); }));
  EXPECT_LT(Clock::now() - began, kSoon);
  EXPECT_EQ(reader->Finish().error_code(), grpc::StatusCode::CANCELLED);
}

}  // namespace
}  // namespace kcs::service::test
