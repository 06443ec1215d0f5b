// A planning server on a real socket of the loopback, and the shortest ways to talk to it.
#pragma once

#include <google/rpc/error_details.pb.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>
#include <kcs/v1/planning.grpc.pb.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "server/service/server.h"

namespace kcs::service::test {

// An answer, or the status that came instead.
template <typename Message>
struct Answer {
  grpc::Status status;
  Message message;
};

// A call gets this long before a test calls it hung.
inline constexpr std::chrono::seconds kDeadline{60};

struct Call : grpc::ClientContext {
  Call() { set_deadline(std::chrono::system_clock::now() + kDeadline); }
};

class TestServer {
 public:
  explicit TestServer(ServerOptions options = {});

  Server& server() { return *server_; }
  const std::string& address() const { return server_->address(); }
  v1::PlanningService::Stub& stub() { return *stub_; }
  // A connection of its own.
  std::shared_ptr<grpc::Channel> new_channel() const;

  // Sends the messages and waits for the plan.
  Answer<v1::Plan> create(const std::vector<v1::CreatePlanRequest>& messages);
  Answer<v1::Plan> get(const std::string& name);
  grpc::Status remove(const std::string& name);
  // All batches of a stream.
  Answer<std::vector<v1::SetpointBatch>> stream(const v1::StreamSetpointsRequest& request);
  Answer<std::vector<v1::Corner>> corners(const std::string& name);

 private:
  std::unique_ptr<Server> server_;
  std::unique_ptr<v1::PlanningService::Stub> stub_;
};

// The worked example of the paper: F = 100, A = 2500, J = 2e5 on each axis.
v1::PlanOptions options(std::uint32_t axes = 2);
v1::CreatePlanRequest request(const v1::PlanOptions& options);
v1::CreatePlanRequest request(const v1::PathChunk& path);
v1::CreatePlanRequest gcode(std::string_view text);
// Points one after the other, all at the same feed.
v1::PathChunk path(const std::vector<double>& points, double feed = 100);
// Two legs of 10 mm at a right angle, 2 axes.
v1::PathChunk right_angle();
v1::StreamSetpointsRequest setpoints(const std::string& name, double period);

// The detail of this kind in a failure's status; an empty one if there is none.
template <typename Detail>
Detail detail(const grpc::Status& status) {
  google::rpc::Status details;
  Detail found;
  details.ParseFromString(status.error_details());
  for (const google::protobuf::Any& any : details.details()) {
    if (any.Is<Detail>()) any.UnpackTo(&found);
  }
  return found;
}

// All that a plan says of its path, byte by byte: what is kept of it on a server does not count.
std::string content(const v1::Plan& plan);

// "field: description" of each violation in a refusal.
std::vector<std::string> violations(const grpc::Status& status);
// The refusal is INVALID_ARGUMENT and one of its violations is of just this field.
::testing::AssertionResult refuses_field(const grpc::Status& status, const std::string& field);

// All numbers of one axis, batch after batch.
std::vector<double> column(const std::vector<v1::SetpointBatch>& batches, int axis,
                           const google::protobuf::RepeatedPtrField<v1::Column>& (v1::SetpointBatch::*channel)()
                               const = &v1::SetpointBatch::position_mm);

// Waits until `condition` holds, for up to kDeadline.
bool eventually(const std::function<bool()>& condition);

}  // namespace kcs::service::test
