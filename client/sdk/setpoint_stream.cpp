#include "client/sdk/setpoint_stream.h"

#include <utility>

#include "client/sdk/messages.h"
#include "client/sdk/setpoint_call.h"
#include "client/sdk/status_error.h"

namespace kcs::client {

SetpointStream::Call::Call(std::shared_ptr<v1::PlanningService::Stub> stub, std::string address,
                           const v1::StreamSetpointsRequest& request, const std::stop_token& stop)
    : stub_(std::move(stub)),
      address_(std::move(address)),
      context_(stop),
      reader_(stub_->StreamSetpoints(&context_, request)) {}

SetpointStream::Call::~Call() {
  if (!reader_) return;
  context_.TryCancel();
  reader_->Finish();
}

bool SetpointStream::Call::next(SetpointBatch& batch) {
  if (!reader_) return false;
  if (reader_->Read(&message_)) {
    from_message(message_, batch);
    return true;
  }
  const grpc::Status status = std::exchange(reader_, nullptr)->Finish();
  if (!status.ok()) throw_error(status, address_);
  return false;
}

SetpointStream::SetpointStream(std::unique_ptr<Call> call) : call_(std::move(call)) {}
SetpointStream::SetpointStream(SetpointStream&&) noexcept = default;
SetpointStream& SetpointStream::operator=(SetpointStream&&) noexcept = default;
SetpointStream::~SetpointStream() = default;

bool SetpointStream::next(SetpointBatch& batch) { return call_->next(batch); }

}  // namespace kcs::client
