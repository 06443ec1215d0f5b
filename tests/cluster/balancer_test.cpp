// Where the balancer sends the calls about a machine, with servers that answer when the test lets them.
#include "tests/cluster/balancer.h"

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <kcs/v1/machine.grpc.pb.h>

#include <atomic>
#include <filesystem>
#include <future>
#include <memory>
#include <string>
#include <thread>

#include "client/sdk/machine_key.h"
#include "tests/cluster/balancer_file.h"
#include "tests/rpc/eventually.h"

namespace kcs::test {
namespace {

constexpr auto kMachine = "machines/mill";

void wait_while(const std::atomic<bool>& it, const grpc::ServerContext& call) {
  while (it && !call.IsCancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

class FakeServer : public v1::MachineService::Service {
 public:
  explicit FakeServer(const Balancer::Place& place) : address_(place.address) {
    const auto port = [](const std::string& address) { return std::stoi(address.substr(address.rfind(':') + 1)); };
    http_.Get("/readyz",
              [this](const httplib::Request&, httplib::Response& answer) { answer.status = ready ? 200 : 503; });
    http_.bind_to_port("127.0.0.1", port(place.http_address));
    http_thread_ = std::thread([this] { http_.listen_after_bind(); });
    server_ = grpc::ServerBuilder()
                  .AddListeningPort(address_, grpc::InsecureServerCredentials())
                  .RegisterService(this)
                  .BuildAndStart();
  }
  ~FakeServer() override {
    server_->Shutdown(std::chrono::system_clock::now());
    http_.stop();
    http_thread_.join();
  }
  FakeServer(const FakeServer&) = delete;
  FakeServer& operator=(const FakeServer&) = delete;

  // Stays until the caller or the balancer breaks it off.
  grpc::Status AttachMachine(
      grpc::ServerContext* call,
      grpc::ServerReaderWriter<v1::AttachMachineResponse, v1::AttachMachineRequest>* stream) override {
    ++gateways;
    wait_while(silent, *call);
    stream->SendInitialMetadata();
    while (!call->IsCancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    --gateways;
    return grpc::Status::OK;
  }

  grpc::Status GetRun(grpc::ServerContext* call, const v1::GetRunRequest*, v1::Run* run) override {
    ++questions;
    wait_while(silent, *call);
    run->set_name(address_);
    return grpc::Status::OK;
  }

  std::atomic<bool> ready = true, silent = false;
  std::atomic<int> gateways = 0, questions = 0;

 private:
  const std::string address_;
  httplib::Server http_;
  std::thread http_thread_;
  std::unique_ptr<grpc::Server> server_;
};

class BalancerTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kHaproxy)) GTEST_SKIP() << "haproxy is not installed";
    balancer_ = std::make_unique<Balancer>(2);
    for (int i = 0; i < 2; ++i) servers_[i] = std::make_unique<FakeServer>(balancer_->place(i));
    ASSERT_TRUE(eventually([&] { return balancer_->sends_to(0) && balancer_->sends_to(1); })) << balancer_->errors();
    stub_ = v1::MachineService::NewStub(grpc::CreateChannel(balancer_->address(), grpc::InsecureChannelCredentials()));
  }

  // Where the machine's gateway is. Its call is there, answered or not.
  int attached() const { return servers_[0]->gateways > 0 ? 0 : 1; }

  // The address of the server that answers a call about the machine.
  std::string who_answers() {
    grpc::ClientContext call;
    call.set_deadline(std::chrono::system_clock::now() + kDeadline);
    client::say_machine(call, kMachine);
    v1::Run run;
    const grpc::Status status = stub_->GetRun(&call, {}, &run);
    return status.ok() ? run.name() : status.error_message();
  }

  struct Gateway {
    explicit Gateway(v1::MachineService::Stub& stub) {
      client::say_machine(call, kMachine);
      stream = stub.AttachMachine(&call);
    }
    ~Gateway() {
      call.TryCancel();
      stream->Finish();
    }
    Gateway(const Gateway&) = delete;
    Gateway& operator=(const Gateway&) = delete;

    grpc::ClientContext call;
    std::unique_ptr<grpc::ClientReaderWriter<v1::AttachMachineRequest, v1::AttachMachineResponse>> stream;
  };

  std::unique_ptr<Balancer> balancer_;
  std::unique_ptr<FakeServer> servers_[2];
  std::unique_ptr<v1::MachineService::Stub> stub_;
};

TEST_F(BalancerTest, ACallUnderWayToTheOldServerDoesNotLeadTheNextOnesThere) {
  auto gateway = std::make_unique<Gateway>(*stub_);
  gateway->stream->WaitForInitialMetadata();
  const int was = attached(), is = 1 - was;
  EXPECT_EQ(who_answers(), balancer_->place(was).address);

  servers_[was]->ready = false;
  ASSERT_TRUE(eventually([&] { return servers_[was]->gateways == 0; }));  // the balancer has broken it off
  servers_[is]->silent = true;
  gateway = std::make_unique<Gateway>(*stub_);
  ASSERT_TRUE(eventually([&] { return servers_[is]->gateways == 1; }));

  // The old server is back before the new one has answered the gateway.
  servers_[was]->ready = true;
  ASSERT_TRUE(eventually([&] { return balancer_->sends_to(was); }));
  servers_[was]->silent = true;
  const int asked = servers_[was]->questions;
  auto under_way = std::async(std::launch::async, [&] { return who_answers(); });
  ASSERT_TRUE(eventually([&] { return servers_[was]->questions > asked; }));

  servers_[is]->silent = false;
  gateway->stream->WaitForInitialMetadata();
  servers_[was]->silent = false;
  EXPECT_EQ(under_way.get(), balancer_->place(was).address);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(who_answers(), balancer_->place(is).address);
}

}  // namespace
}  // namespace kcs::test
