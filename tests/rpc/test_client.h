// A client of a planning server, with the shortest ways to each of its calls.
#pragma once

#include <grpcpp/grpcpp.h>
#include <kcs/v1/planning.grpc.pb.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/rpc/eventually.h"

namespace kcs::test {

// An answer, or the status that came instead.
template <typename Message>
struct Answer {
  grpc::Status status;
  Message message;
};

// A call gets kDeadline before a test calls it hung.
struct Call : grpc::ClientContext {
  Call() { set_deadline(std::chrono::system_clock::now() + kDeadline); }
};

// A connection of its own, which gRPC shares with no other channel to the same address.
std::shared_ptr<grpc::Channel> new_channel(
    const std::string& address,
    const std::shared_ptr<grpc::ChannelCredentials>& credentials = grpc::InsecureChannelCredentials());

class TestClient {
 public:
  // token: shown with every call of its own; empty: none is.
  explicit TestClient(std::shared_ptr<grpc::Channel> channel, std::string token = "");

  const std::shared_ptr<grpc::Channel>& channel() const { return channel_; }
  v1::PlanningService::Stub& stub() { return *stub_; }
  // A call with the client's token.
  std::unique_ptr<Call> call() const;

  // Sends the messages and waits for the plan.
  Answer<v1::Plan> create(const std::vector<v1::CreatePlanRequest>& messages);
  Answer<v1::Plan> get(const std::string& name);
  grpc::Status remove(const std::string& name);
  // One page of the list, or all of them one after the other.
  Answer<v1::ListPlansResponse> list(const v1::ListPlansRequest& request = {});
  Answer<std::vector<v1::Plan>> list_all();
  // All messages of WatchPlan.
  Answer<std::vector<v1::PlanProgress>> watch(const std::string& name);
  // All batches of a stream.
  Answer<std::vector<v1::SetpointBatch>> stream(const v1::StreamSetpointsRequest& request);
  Answer<std::vector<v1::Corner>> corners(const std::string& name);

  // Waits until the plan is READY, and returns it.
  v1::Plan wait_until_ready(const std::string& name);

 private:
  const std::shared_ptr<grpc::Channel> channel_;
  const std::unique_ptr<v1::PlanningService::Stub> stub_;
  const std::string token_;
};

// All that a plan says of its path, byte by byte: what is kept of it on a server does not count.
std::string content(const v1::Plan& plan);

// Each batch, byte by byte.
std::vector<std::string> bytes(const std::vector<v1::SetpointBatch>& batches);

}  // namespace kcs::test
