// What is too much for a server is refused with the name of the cap, before it does harm.
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>

#include "tests/service/kept_plans.h"
#include "tests/service/test_server.h"

namespace kcs::service::test {
namespace {

::testing::AssertionResult exhausts(const grpc::Status& status, const std::string& cap) {
  if (status.error_code() == grpc::StatusCode::RESOURCE_EXHAUSTED &&
      status.error_message().find(cap) != std::string::npos) {
    return ::testing::AssertionSuccess();
  }
  return ::testing::AssertionFailure() << status.error_code() << ": " << status.error_message();
}

// Or a small message could become a thousand times as large before anyone measures it.
TEST(Caps, CompressedMessagesAreNotTaken) {
  TestServer server;
  Call call;
  call.set_compression_algorithm(GRPC_COMPRESS_GZIP);
  v1::GetPlanRequest request;
  request.set_name(std::string(100'000, 'a'));
  v1::Plan plan;
  const grpc::Status status = server.stub().GetPlan(&call, request, &plan);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::UNIMPLEMENTED) << status.error_message();
}

TEST(Caps, PointsPerPlan) {
  TestServer server({.caps = {.points_per_plan = 10}});
  EXPECT_TRUE(server.create({request(options()), request(zigzag(10))}).status.ok());
  EXPECT_TRUE(exhausts(server.create({request(options()), request(zigzag(11))}).status, "points_per_plan = 10"));
  EXPECT_TRUE(exhausts(server.create({request(options()), request(zigzag(6)), request(zigzag(6))}).status,
                       "points_per_plan = 10"));
}

TEST(Caps, SegmentsOfGcode) {
  TestServer server({.caps = {.points_per_plan = 10}});
  std::string program = "G1 F600\n";
  for (int i = 1; i <= 11; ++i) program += "X" + std::to_string(i) + " Y" + std::to_string(i % 2) + "\n";
  EXPECT_TRUE(exhausts(server.create({request(options()), gcode(program)}).status, "points_per_plan = 10"));
  // One short line, millions of chords.
  EXPECT_TRUE(exhausts(server.create({request(options()), gcode("G64 P0.000000001\nG2 X0 Y0 I1000000 F600\n")}).status,
                       "points_per_plan = 10"));
}

TEST(Caps, BytesOfGcode) {
  TestServer server({.caps = {.gcode_bytes = 1000}});
  const std::string comment = "(" + std::string(598, 'x') + ")\n";
  EXPECT_TRUE(
      exhausts(server.create({request(options()), gcode(comment), gcode(comment)}).status, "gcode_bytes = 1000"));
}

TEST(Caps, UploadEndsWhereACapIsPassed) {
  TestServer server({.caps = {.points_per_plan = 10}});
  Call call;
  v1::Plan plan;
  const auto writer = server.stub().CreatePlan(&call, &plan);
  writer->Write(request(options()));
  writer->Write(request(zigzag(11)));
  EXPECT_TRUE(eventually([&] { return !writer->Write(request(zigzag(11))); })) << "it goes on reading";
  EXPECT_TRUE(exhausts(writer->Finish(), "points_per_plan"));
}

TEST(Caps, MessageSize) {
  TestServer server({.caps = {.message_bytes = 10'000}});
  // The points before the large message would make a plan by themselves.
  const auto answer = server.create({request(options()), request(zigzag(100)), request(zigzag(2000))});
  EXPECT_EQ(answer.status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED) << answer.status.error_message();
  EXPECT_TRUE(server.create({request(options()), request(zigzag(100))}).status.ok());
}

TEST(Caps, WhatMemoryHasNoRoomForIsPlannedAgain) {
  TestServer server({.caps = {.cached_plans = 1}});
  const std::string name = server.create({request(options()), request(zigzag(300))}).message.name();
  const auto before = server.stream(setpoints(name, 0.001)).message;
  ASSERT_TRUE(server.create({request(options()), request(zigzag(3))}).status.ok());
  const auto after = server.stream(setpoints(name, 0.001));
  ASSERT_TRUE(after.status.ok()) << after.status.error_message();
  ASSERT_EQ(after.message.size(), before.size());
  EXPECT_EQ(bytes(after.message), bytes(before));
}

// However short a client's patience: each time he asks, more of it is done.
TEST(Caps, WhatIsPlannedAgainIsGoneOnWithWhenItsClientGivesUp) {
  TestServer server({.planning_threads = 1, .caps = {.cached_plans = 1}});
  const std::string name = server.create({request(options()), request(long_path())}).message.name();
  ASSERT_TRUE(server.create({request(options()), request(zigzag(3))}).status.ok());
  EXPECT_TRUE(eventually([&] {
    grpc::ClientContext call;
    call.set_deadline(std::chrono::system_clock::now() + std::chrono::milliseconds(100));
    const auto reader = server.stub().StreamSetpoints(&call, setpoints(name, 1));
    v1::SetpointBatch batch;
    const bool is_there = reader->Read(&batch);
    call.TryCancel();
    reader->Finish();
    return is_there;
  }));
}

TEST(Caps, PlanThatIsLargerThanTheCache) {
  TestServer server({.caps = {.cached_bytes = 50'000}});
  EXPECT_TRUE(server.create({request(options()), request(zigzag(3))}).status.ok());
  EXPECT_TRUE(exhausts(server.create({request(options()), request(zigzag(1000))}).status, "cached_bytes = 50000"));
}

TEST(Caps, UploadsAtTheSameTime) {
  TestServer server({.caps = {.uploads = 1}});
  Call call;
  v1::Plan plan;
  const auto first = server.stub().CreatePlan(&call, &plan);
  first->Write(request(options()));
  EXPECT_TRUE(eventually([&] {
    return exhausts(server.create({request(options()), request(zigzag(3))}).status, "uploads = 1");
  }));
  first->Write(request(zigzag(3)));
  first->WritesDone();
  EXPECT_TRUE(first->Finish().ok());
  EXPECT_TRUE(eventually([&] { return server.create({request(options()), request(zigzag(4))}).status.ok(); }));
}

TEST(Caps, StreamsAtTheSameTime) {
  TestServer server({.caps = {.streams = 1}});
  v1::PlanOptions slow = options();
  slow.set_feed_mm_s(0.1);
  const std::string name = server.create({request(slow), request(right_angle())}).message.name();
  Call call;
  const auto reader = server.stub().StreamSetpoints(&call, setpoints(name, 1e-5));
  v1::SetpointBatch batch;
  ASSERT_TRUE(reader->Read(&batch));
  EXPECT_TRUE(exhausts(server.stream(setpoints(name, 1)).status, "streams = 1"));
  EXPECT_TRUE(exhausts(server.corners(name).status, "streams = 1"));
  call.TryCancel();
  reader->Finish();
  EXPECT_TRUE(eventually([&] { return server.stream(setpoints(name, 1)).status.ok(); }));
}

}  // namespace
}  // namespace kcs::service::test
