// The services that tools expect of any gRPC server: health and reflection.
#include <grpcpp/impl/rpc_method.h>
#include <gtest/gtest.h>

#include <string>
#include <thread>

#include "tests/service/test_server.h"

namespace kcs::service::test {
namespace {

// A conversation in raw bytes, as the messages of these services are in no header of the libraries.
class RawCall {
 public:
  RawCall(const TestServer& server, const char* method)
      : channel_(new_channel(server.address())),
        stream_(grpc::internal::ClientReaderWriterFactory<grpc::ByteBuffer, grpc::ByteBuffer>::Create(
            channel_.get(), grpc::internal::RpcMethod(method, grpc::internal::RpcMethod::BIDI_STREAMING), &call_)) {}

  // The answer to `message`; empty if there is none.
  std::string ask(const std::string& message) {
    const grpc::Slice slice(message);
    stream_->Write(grpc::ByteBuffer(&slice, 1));
    grpc::ByteBuffer answer;
    grpc::Slice bytes;
    if (!stream_->Read(&answer) || !answer.DumpToSingleSlice(&bytes).ok()) return {};
    return {bytes.begin(), bytes.end()};
  }

  grpc::Status finish() {
    stream_->WritesDone();
    return stream_->Finish();
  }

 private:
  Call call_;
  std::shared_ptr<grpc::Channel> channel_;
  std::unique_ptr<grpc::ClientReaderWriter<grpc::ByteBuffer, grpc::ByteBuffer>> stream_;
};

std::string health_request(const std::string& service) {
  return service.empty() ? "" : std::string("\x0a") + static_cast<char>(service.size()) + service;
}

TEST(Health, TellsThatTheServerAndItsServiceAreServing) {
  const TestServer server;
  constexpr const char* kCheck = "/grpc.health.v1.Health/Check";
  for (const std::string service : {"", "kcs.v1.PlanningService"}) {
    RawCall check(server, kCheck);
    EXPECT_EQ(check.ask(health_request(service)), "\x08\x01") << "not SERVING: " << service;
    EXPECT_TRUE(check.finish().ok());
  }
  RawCall unknown(server, kCheck);
  unknown.ask(health_request("none"));
  EXPECT_EQ(unknown.finish().error_code(), grpc::StatusCode::NOT_FOUND);
}

TEST(Health, TellsThatAStoppingServerIsNotServing) {
  TestServer server;
  const std::string name = server.create({request(options()), request(zigzag(200))}).message.name();
  Call call;
  const auto reader = server.stub().StreamSetpoints(&call, setpoints(name, 1e-5));
  v1::SetpointBatch batch;
  ASSERT_TRUE(reader->Read(&batch)) << "no call is under way that the server would wait for";
  std::thread stopping([&] { server.server().stop(kDeadline); });
  for (const std::string service : {"", "kcs.v1.PlanningService"}) {
    EXPECT_TRUE(eventually([&] {
      RawCall check(server, "/grpc.health.v1.Health/Check");
      return check.ask(health_request(service)) == "\x08\x02";
    })) << "still SERVING: "
        << service;
  }
  call.TryCancel();
  reader->Finish();
  stopping.join();
}

TEST(Channelz, TellsNothingUnlessAskedTo) {
  const TestServer server;
  RawCall servers(server, "/grpc.channelz.v1.Channelz/GetServers");
  servers.ask("");
  EXPECT_EQ(servers.finish().error_code(), grpc::StatusCode::UNIMPLEMENTED);
}

TEST(Reflection, ListsTheServiceAndItsContract) {
  const TestServer server;
  RawCall reflection(server, "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo");
  EXPECT_NE(reflection.ask("\x3a\x01*").find("kcs.v1.PlanningService"), std::string::npos);
  const std::string symbol = "kcs.v1.PlanningService.CreatePlan";
  EXPECT_NE(
      reflection.ask(std::string("\x22") + static_cast<char>(symbol.size()) + symbol).find("kcs/v1/planning.proto"),
      std::string::npos);
  EXPECT_TRUE(reflection.finish().ok());
}

}  // namespace
}  // namespace kcs::service::test
