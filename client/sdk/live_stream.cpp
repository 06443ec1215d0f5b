#include "client/sdk/live_stream.h"

#include <algorithm>
#include <utility>

#include "client/sdk/live_call.h"
#include "client/sdk/messages.h"
#include "client/sdk/status_error.h"

namespace kcs::client {

LiveStream::Call::Call(std::shared_ptr<v1::PlanningService::Stub> stub, std::string address,
                       const v1::PlanLiveRequest& first, const std::stop_token& stop)
    : stub_(std::move(stub)),
      address_(std::move(address)),
      context_(stop),
      stream_(stub_->PlanLive(&context_)),
      axes_(std::max<std::size_t>(first.options().machine().axes(), 1)) {
  stream_->Write(first);  // if the server refuses it, next() says so
}

LiveStream::Call::~Call() {
  if (ended_) return;
  context_.TryCancel();
  stream_->Finish();
}

bool LiveStream::Call::send(std::string_view gcode) {
  for (; !gcode.empty(); gcode.remove_prefix(std::min(kGcodeBytesPerMessage, gcode.size()))) {
    request_.mutable_gcode()->assign(gcode.substr(0, kGcodeBytesPerMessage));
    if (!stream_->Write(request_)) return false;
  }
  return true;
}

bool LiveStream::Call::send(const PointPath& piece) {
  const std::size_t points = count_points(piece, axes_);
  for (std::size_t first = 0; first < points; first += kPointsPerMessage) {
    *request_.mutable_path() = to_message(piece, axes_, first, kPointsPerMessage);
    if (!stream_->Write(request_)) return false;
  }
  return true;
}

bool LiveStream::Call::next(SetpointBatch& batch) {
  while (!ended_ && stream_->Read(&response_)) {
    if (response_.has_setpoints()) {
      from_message(response_.setpoints(), batch);
      return true;
    }
    for (const v1::Corner& corner : response_.corners().corners()) corners_.push_back(from_message(corner));
    if (response_.has_plan()) plan_ = from_message(response_.plan());
  }
  if (std::exchange(ended_, true)) return false;
  const grpc::Status status = stream_->Finish();
  if (!status.ok()) throw_error(status, address_);
  return false;
}

std::vector<Corner> LiveStream::Call::take_corners() { return std::exchange(corners_, {}); }

LiveStream::LiveStream(std::unique_ptr<Call> call) : call_(std::move(call)) {}
LiveStream::LiveStream(LiveStream&&) noexcept = default;
LiveStream& LiveStream::operator=(LiveStream&&) noexcept = default;
LiveStream::~LiveStream() = default;

bool LiveStream::send(std::string_view gcode) { return call_->send(gcode); }
bool LiveStream::send(const PointPath& piece) { return call_->send(piece); }
void LiveStream::end_path() { call_->end_path(); }
bool LiveStream::next(SetpointBatch& batch) { return call_->next(batch); }
std::vector<Corner> LiveStream::take_corners() { return call_->take_corners(); }
const Plan& LiveStream::plan() const { return call_->plan(); }

}  // namespace kcs::client
