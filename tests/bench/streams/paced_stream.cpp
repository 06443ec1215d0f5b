#include "tests/bench/streams/paced_stream.h"

#include <algorithm>
#include <cmath>

namespace kcs::bench {

PacedStream::PacedStream(v1::PlanningService::Stub& stub, const v1::StreamSetpointsRequest& request)
    : period_(request.period_s()), lead_(request.lead_s()), start_(Clock::now()) {
  stub.async()->StreamSetpoints(&context_, &request, this);
  StartRead(&batch_);
  StartCall();
}

std::string PacedStream::finish() {
  const grpc::Status status = done_.get_future().get();
  if (!status.ok()) return status.error_message();
  return complete_ ? "" : "setpoints are missing";
}

void PacedStream::OnReadDone(bool ok) {
  if (!ok) return;
  const double now = std::chrono::duration<double>(Clock::now() - start_).count();
  const double time = static_cast<double>(batch_.first_index()) * period_;
  delays_.push_back(static_cast<float>(now - std::max(0.0, time - lead_)));
  complete_ = complete_ && batch_.first_index() == next_;
  const auto size = static_cast<std::uint64_t>(batch_.position_mm(0).values_size());
  const double after = now - time - kLate;
  if (after > 0) late_ += std::min(size, static_cast<std::uint64_t>(std::ceil(after / period_)));
  next_ = batch_.first_index() + size;
  StartRead(&batch_);
}

void PacedStream::OnDone(const grpc::Status& status) { done_.set_value(status); }

}  // namespace kcs::bench
