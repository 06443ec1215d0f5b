// What clients that do not read cost a real kcsd.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "tests/rpc/requests.h"
#include "tests/rpc/test_client.h"
#include "tests/system/kcsd_process.h"

namespace kcs::test {
namespace {

constexpr int kReaders = 100;

class SlowReaders : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto plan = client_.create({request(options(3)), request(path({0, 0, 0, 1000, 0, 0, 0, 0, 0}))});
    ASSERT_TRUE(plan.status.ok()) << plan.status.error_message();
    request_ = setpoints(plan.message.name(), 1e-5);  // 2 million setpoints
    for (const v1::Channel channel : {v1::CHANNEL_VELOCITY, v1::CHANNEL_ACCELERATION, v1::CHANNEL_JERK,
                                      v1::CHANNEL_PATH_POSITION, v1::CHANNEL_SEGMENT}) {
      request_.add_channels(channel);
    }
  }

  // Of the server, bytes.
  std::size_t memory() const { return kcsd_.status_figure("VmRSS:") * 1024; }

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

  const KcsdProcess kcsd_{{KCSD, "--database", "memory", "--listen", "127.0.0.1:0", "--log-level", "off"}};
  TestClient client_{new_channel(kcsd_.address())};
  v1::StreamSetpointsRequest request_;
};

TEST_F(SlowReaders, CostOneBatchEachAndHoldUpNobody) {
  // A batch of 4096 setpoints with 14 numbers each is 0.45 MB; it is there as a message and as the bytes on their way.
  const std::size_t most = memory_at_rest() + kReaders * (2 << 20);
  std::vector<std::unique_ptr<v1::PlanningService::Stub>> stubs;
  std::vector<std::unique_ptr<grpc::ClientContext>> calls;
  std::vector<std::unique_ptr<grpc::ClientReader<v1::SetpointBatch>>> readers;
  for (int i = 0; i < kReaders; ++i) {
    if (i % 10 == 0) stubs.push_back(v1::PlanningService::NewStub(new_channel(kcsd_.address())));
    calls.push_back(std::make_unique<grpc::ClientContext>());
    readers.push_back(stubs.back()->StreamSetpoints(calls.back().get(), request_));
  }
  EXPECT_LT(memory_at_rest(), most);

  // While others are served, however much, it stays so.
  for (int round = 0; round < 3; ++round) {
    grpc::ClientContext call;
    const auto reader = client_.stub().StreamSetpoints(&call, request_);
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
