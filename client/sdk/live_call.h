// A running PlanLive call. Used inside the library alone.
#pragma once

#include <grpcpp/support/sync_stream.h>

#include <cstddef>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "client/sdk/call_context.h"
#include "client/sdk/live_stream.h"
#include "kcs/v1/planning.grpc.pb.h"

namespace kcs::client {

class LiveStream::Call {
 public:
  // Sends the first message.
  Call(std::shared_ptr<v1::PlanningService::Stub> stub, std::string address, const v1::PlanLiveRequest& first,
       const std::stop_token& stop);
  ~Call();
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;

  bool send(std::string_view gcode);
  bool send(const PointPath& piece);
  void end_path() { stream_->WritesDone(); }

  bool next(SetpointBatch& batch);
  std::vector<Corner> take_corners();
  const Plan& plan() const { return plan_; }

 private:
  std::shared_ptr<v1::PlanningService::Stub> stub_;  // kept as long as the call runs
  std::string address_;
  CallContext context_;
  std::unique_ptr<grpc::ClientReaderWriter<v1::PlanLiveRequest, v1::PlanLiveResponse>> stream_;
  // Of the thread that sends:
  std::size_t axes_;
  v1::PlanLiveRequest request_;  // kept for its memory
  // Of the thread that receives:
  v1::PlanLiveResponse response_;
  std::vector<Corner> corners_;  // that nobody took yet
  Plan plan_;
  bool ended_ = false;
};

}  // namespace kcs::client
