// A running StreamSetpoints call. Used inside the library alone.
#pragma once

#include <grpcpp/support/status.h>
#include <grpcpp/support/sync_stream.h>

#include <memory>
#include <optional>
#include <stop_token>

#include "client/sdk/call_context.h"
#include "client/sdk/connection.h"
#include "client/sdk/setpoint_stream.h"
#include "kcs/v1/planning.grpc.pb.h"

namespace kcs::client {

class SetpointStream::Call {
 public:
  Call(std::shared_ptr<v1::PlanningService::Stub> stub, const Connection& server,
       const v1::StreamSetpointsRequest& request, const std::stop_token& stop);
  ~Call();
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;

  bool next(SetpointBatch& batch);

 private:
  void open();
  bool can_go_on(const grpc::Status& status);

  std::shared_ptr<v1::PlanningService::Stub> stub_;  // kept as long as the call runs
  Connection server_;
  v1::StreamSetpointsRequest request_;  // what is still wanted
  std::stop_token stop_;
  std::optional<CallContext> context_;
  std::unique_ptr<grpc::ClientReader<v1::SetpointBatch>> reader_;  // none when the stream has ended
  v1::SetpointBatch message_;                                      // kept for its memory
  bool has_answered_ = false;                                      // since it was opened last
  bool is_complete_ = false;                                       // all that is wanted has come
};

}  // namespace kcs::client
