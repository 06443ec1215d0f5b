#include "client/sdk/setpoint_stream.h"

#include <utility>

#include "client/sdk/messages.h"
#include "client/sdk/setpoint_call.h"
#include "client/sdk/status_error.h"

namespace kcs::client {

SetpointStream::Call::Call(std::shared_ptr<v1::PlanningService::Stub> stub, const Connection& server,
                           const v1::StreamSetpointsRequest& request, const std::stop_token& stop)
    : stub_(std::move(stub)), server_(server), request_(request), stop_(stop) {
  open();
}

SetpointStream::Call::~Call() {
  if (!reader_) return;
  context_->TryCancel();
  reader_->Finish();
}

void SetpointStream::Call::open() {
  context_.emplace(stop_);
  reader_ = stub_->StreamSetpoints(&*context_, request_);
  has_answered_ = false;
}

bool SetpointStream::Call::next(SetpointBatch& batch) {
  while (reader_) {
    if (reader_->Read(&message_)) {
      from_message(message_, batch);
      const std::uint64_t next_index = batch.first_index + batch.size();
      request_.set_first_index(next_index);
      has_answered_ = true;
      is_complete_ = batch.end_of_path || (request_.has_last_index() && next_index > request_.last_index());
      return true;
    }
    const grpc::Status status = std::exchange(reader_, nullptr)->Finish();
    if (status.ok() || is_complete_) return false;
    if (!can_go_on(status)) throw_error(status, server_.address);
    open();
  }
  return false;
}

// A server that went away in the middle: whoever is there now gives the same setpoints. gRPC itself tries again what
// has not been answered at all (channel.h). The pace of a machine is not taken up: it counts from the call's time.
bool SetpointStream::Call::can_go_on(const grpc::Status& status) {
  return server_.tries_again && is_lost(status) && !stop_.stop_requested() && has_answered_ && !request_.has_lead_s();
}

SetpointStream::SetpointStream(std::unique_ptr<Call> call) : call_(std::move(call)) {}
SetpointStream::SetpointStream(SetpointStream&&) noexcept = default;
SetpointStream& SetpointStream::operator=(SetpointStream&&) noexcept = default;
SetpointStream::~SetpointStream() = default;

bool SetpointStream::next(SetpointBatch& batch) { return call_->next(batch); }

}  // namespace kcs::client
