// Clients that give up, that are slow, that come all at once; and a server that stops.
#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/service/test_server.h"

namespace kcs::service::test {
namespace {

// Resident memory of this process, bytes.
std::size_t resident_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::size_t kilobytes = 0;
    if (word == "VmRSS:" && status >> kilobytes) return kilobytes * 1024;
  }
  return 0;
}

class Lifecycle : public ::testing::Test {
 protected:
  std::string long_plan() {
    v1::PlanOptions slow = options();
    slow.set_feed_mm_s(0.1);
    const auto plan = server_.create({request(slow), request(path({0, 0, 100, 0, 100, 100}))});
    EXPECT_TRUE(plan.status.ok()) << plan.status.error_message();
    EXPECT_GT(plan.message.summary().cycle_time_s(), 1999);
    return plan.message.name();
  }

  void expect_serving() { EXPECT_TRUE(server_.create({request(options()), request(right_angle())}).status.ok()); }

  TestServer server_{{.caps = {.uploads = 4, .streams = 300}}};
};

TEST_F(Lifecycle, CancelledUploadsLeaveNothingBehind) {
  for (int round = 0; round < 20; ++round) {
    Call call;
    v1::Plan plan;
    const auto writer = server_.stub().CreatePlan(&call, &plan);
    writer->Write(request(options()));
    if (round % 2 == 0) writer->Write(request(right_angle()));
    call.TryCancel();
    EXPECT_EQ(writer->Finish().error_code(), grpc::StatusCode::CANCELLED);
  }
  EXPECT_TRUE(eventually([this] { return server_.create({request(options()), request(right_angle())}).status.ok(); }));
}

TEST_F(Lifecycle, ClientThatVanishesWithinAnUploadFreesItsPlace) {
  for (int round = 0; round < 8; ++round) {
    Call call;
    v1::Plan plan;
    const auto stub = v1::PlanningService::NewStub(new_channel(server_.address()));
    const auto writer = stub->CreatePlan(&call, &plan);
    writer->Write(request(options()));
    call.TryCancel();
    writer->Finish();
  }
  EXPECT_TRUE(eventually([this] { return server_.create({request(options()), request(right_angle())}).status.ok(); }));
}

TEST_F(Lifecycle, StreamsCancelledInTheMiddleLeaveNothingBehind) {
  const std::string name = long_plan();
  for (int round = 0; round < 50; ++round) {
    Call call;
    const auto reader = server_.stub().StreamSetpoints(&call, setpoints(name, 1e-5));
    v1::SetpointBatch batch;
    ASSERT_TRUE(reader->Read(&batch));
    call.TryCancel();
    while (reader->Read(&batch)) continue;
    EXPECT_EQ(reader->Finish().error_code(), grpc::StatusCode::CANCELLED);
  }
  expect_serving();
}

TEST_F(Lifecycle, ReaderThatDoesNotReadDoesNotGrowTheServer) {
  const std::string name = long_plan();  // 200 million setpoints, 3.2 GB
  Call call;
  const auto reader = server_.stub().StreamSetpoints(&call, setpoints(name, 1e-5));
  v1::SetpointBatch batch;
  ASSERT_TRUE(reader->Read(&batch));
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  const std::size_t before = resident_memory();
  std::this_thread::sleep_for(std::chrono::seconds(1));
  EXPECT_LT(resident_memory(), before + (4U << 20));
  ASSERT_TRUE(reader->Read(&batch));
  EXPECT_EQ(batch.first_index(), 4096U);
  call.TryCancel();
  reader->Finish();
}

TEST_F(Lifecycle, HundredsOfSlowReadersLeaveRoomForOthers) {
  const std::string name = long_plan();
  constexpr int kReaders = 250;
  std::vector<std::unique_ptr<Call>> calls;
  std::vector<std::unique_ptr<grpc::ClientReader<v1::SetpointBatch>>> readers;
  v1::SetpointBatch batch;
  for (int i = 0; i < kReaders; ++i) {
    calls.push_back(std::make_unique<Call>());
    readers.push_back(server_.stub().StreamSetpoints(calls.back().get(), setpoints(name, 1e-5)));
  }
  for (const auto& reader : readers) ASSERT_TRUE(reader->Read(&batch));
  expect_serving();
  EXPECT_TRUE(server_.stream(setpoints(name, 10)).status.ok());
  for (const auto& call : calls) call->TryCancel();
  for (const auto& reader : readers) reader->Finish();
}

TEST_F(Lifecycle, SilentUploadDoesNotKeepOthersOut) {
  Call call;
  v1::Plan plan;
  const auto silent = server_.stub().CreatePlan(&call, &plan);
  silent->Write(request(options()));
  expect_serving();
  call.TryCancel();
  silent->Finish();
}

TEST(Stop, LetsARunningStreamFinish) {
  TestServer server;
  const std::string name = server.create({request(options()), request(right_angle())}).message.name();
  auto request = setpoints(name, 1e-5);
  request.set_batch_size(100);
  Call call;
  const auto reader = server.stub().StreamSetpoints(&call, request);
  v1::SetpointBatch batch;
  ASSERT_TRUE(reader->Read(&batch));
  std::thread stopping([&] { server.server().stop(std::chrono::seconds(30)); });
  while (reader->Read(&batch)) continue;
  const grpc::Status status = reader->Finish();
  EXPECT_TRUE(status.ok()) << status.error_message();
  EXPECT_TRUE(batch.end_of_path());
  stopping.join();
  EXPECT_EQ(server.get(name).status.error_code(), grpc::StatusCode::UNAVAILABLE);
}

TEST(Stop, CancelsWhatOutlastsTheGrace) {
  TestServer server;
  const std::string name = server.create({request(options()), request(right_angle())}).message.name();
  Call call;
  v1::Plan plan;
  const auto upload = server.stub().CreatePlan(&call, &plan);
  upload->Write(request(options()));
  ASSERT_TRUE(server.get(name).status.ok());
  const auto began = std::chrono::steady_clock::now();
  server.server().stop(std::chrono::milliseconds(100));
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(10));
  EXPECT_FALSE(upload->Finish().ok());
}

TEST(Listen, PortInUseIsRefusedWithTheRemedy) {
  TestServer server;
  try {
    const Server second({.listen = server.server().address()});
    ADD_FAILURE() << "listens on a port that is in use";
  } catch (const std::runtime_error& refused) {
    EXPECT_NE(std::string(refused.what()).find(server.server().address()), std::string::npos) << refused.what();
    EXPECT_NE(std::string(refused.what()).find("another program"), std::string::npos) << refused.what();
  }
}

TEST(Listen, AddressWithoutAPortIsRefused) {
  for (const std::string address : {"localhost", "127.0.0.1:", ":80x", "127.0.0.1:http"}) {
    EXPECT_THROW(const Server server({.listen = address}), std::runtime_error) << address;
  }
}

TEST(Listen, UnixSocketServes) {
  const std::string path = ::testing::TempDir() + "kcsd-test-" + std::to_string(getpid()) + ".sock";
  const Server server({.listen = "unix:" + path});
  EXPECT_EQ(server.address(), "unix:" + path);
  const auto stub =
      v1::PlanningService::NewStub(grpc::CreateChannel(server.address(), grpc::InsecureChannelCredentials()));
  Call call;
  v1::Plan plan;
  EXPECT_EQ(stub->GetPlan(&call, v1::GetPlanRequest(), &plan).error_code(), grpc::StatusCode::INVALID_ARGUMENT);
}

TEST(Listen, ServerWithoutASocketServesInsideTheProcess) {
  Server server({.listen = ""});
  const auto stub = v1::PlanningService::NewStub(server.in_process_channel());
  Call call;
  v1::Plan plan;
  const auto writer = stub->CreatePlan(&call, &plan);
  writer->Write(request(options()));
  writer->Write(request(right_angle()));
  writer->WritesDone();
  EXPECT_TRUE(writer->Finish().ok());
  EXPECT_EQ(server.address(), "");
}

}  // namespace
}  // namespace kcs::service::test
