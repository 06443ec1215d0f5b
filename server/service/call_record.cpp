#include "server/service/call_record.h"

#include <absl/status/status.h>

#include <algorithm>

#include "server/service/peer.h"
#include "server/service/printable.h"
#include "server/service/request_id.h"
#include "server/service/status_details.h"

namespace kcs::service {
namespace {

std::string name_of(grpc::StatusCode code) {
  return absl::StatusCodeToString(static_cast<absl::StatusCode>(code));  // the same numbers
}

// How a call ended that was answered with `code`.
enum class Ending { kDone, kCancelled, kRefused, kFailed };

Ending ending_of(grpc::StatusCode code) {
  switch (code) {
    case grpc::StatusCode::OK:
      return Ending::kDone;
    case grpc::StatusCode::CANCELLED:
    case grpc::StatusCode::DEADLINE_EXCEEDED:
      return Ending::kCancelled;
    case grpc::StatusCode::INTERNAL:
    case grpc::StatusCode::UNKNOWN:
    case grpc::StatusCode::DATA_LOSS:
      return Ending::kFailed;
    default:
      return Ending::kRefused;
  }
}

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c; });
  return text;
}

}  // namespace

CallRecord::CallRecord(const Observation& observation, std::string_view method, grpc::ServerContext& context)
    : observation_(observation),
      method_(method),
      context_(context),
      request_id_(request_id_of(context)),
      running_(observation.metrics.rpcs_running.with({method_})) {
  // Not the initial metadata: an answer that has begun is tried again by no client (gRFC A6), even if it is a refusal.
  context.AddTrailingMetadata(kRequestIdKey, request_id_);
}

void CallRecord::note(const std::string& field, std::string_view text) {
  constexpr std::size_t kMostBytes = 100;
  notes_[field] = printable(text, kMostBytes);
}

grpc::Status CallRecord::finish(const CallEnd& end) {
  count(end);
  log(end);
  return end.status.ok() ? end.status : with_request_id(end.status, request_id_);
}

void CallRecord::count(const CallEnd& end) const {
  const observe::ServerMetrics& metrics = observation_.metrics;
  const std::string code = name_of(end.status.error_code());
  metrics.rpcs.with({method_, code}).add();
  metrics.rpc_duration.with({method_}).observe(std::chrono::steady_clock::now() - began_);
  if (ending_of(end.status.error_code()) == Ending::kRefused) {
    metrics.rejections.with({end.cap.empty() ? lower_case(code) : end.cap}).add();
  }
}

void CallRecord::log(const CallEnd& end) const {
  const grpc::Status& status = end.status;
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - began_;
  observe::LogFields fields = {{"request_id", request_id_},
                               {"method", method_},
                               {"peer", peer_of(context_)},
                               {"status", name_of(status.error_code())},
                               {"duration_s", taken.count()}};
  if (!end.reason.empty()) fields["reason"] = end.reason;
  for (const auto& [field, value] : notes_.items()) fields[field] = value;
  switch (ending_of(status.error_code())) {
    case Ending::kDone:
      return observation_.log.write(spdlog::level::info, method_ + " done", fields);
    case Ending::kCancelled:
      return observation_.log.write(spdlog::level::info, method_ + " cancelled", fields);
    case Ending::kRefused:
      return observation_.log.write(spdlog::level::info, method_ + " refused: " + status.error_message(), fields);
    case Ending::kFailed:
      return observation_.log.write(spdlog::level::err, method_ + " failed: " + status.error_message(), fields);
  }
}

}  // namespace kcs::service
