#include "client/sdk/status_error.h"

#include <fmt/core.h>

#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "client/sdk/error.h"
#include "google/rpc/error_details.pb.h"

namespace kcs::client {
namespace {

std::string code_name(grpc::StatusCode code) {
  // In the order of their numbers, which start at 0.
  static constexpr std::array<std::string_view, 17> kNames = {
      "OK",        "CANCELLED",      "UNKNOWN",           "INVALID_ARGUMENT",   "DEADLINE_EXCEEDED",
      "NOT_FOUND", "ALREADY_EXISTS", "PERMISSION_DENIED", "RESOURCE_EXHAUSTED", "FAILED_PRECONDITION",
      "ABORTED",   "OUT_OF_RANGE",   "UNIMPLEMENTED",     "INTERNAL",           "UNAVAILABLE",
      "DATA_LOSS", "UNAUTHENTICATED"};
  const auto index = static_cast<std::size_t>(code);
  return index < kNames.size() ? std::string(kNames[index]) : fmt::format("CODE_{}", static_cast<int>(code));
}

std::vector<FieldViolation> violations_of(const grpc::Status& status) {
  std::vector<FieldViolation> violations;
  google::rpc::Status details;
  if (!details.ParseFromString(status.error_details())) return violations;
  for (const google::protobuf::Any& detail : details.details()) {
    google::rpc::BadRequest request;
    if (!detail.UnpackTo(&request)) continue;
    for (const auto& violation : request.field_violations()) {
      violations.push_back({violation.field(), violation.description()});
    }
  }
  return violations;
}

}  // namespace

void throw_error(const grpc::Status& status, const std::string& address) {
  std::string message = status.error_message();
  if (!address.empty() && status.error_code() == grpc::StatusCode::UNAVAILABLE) {
    message = fmt::format("kcsd at {} is not available: {}", address, message);
  } else if (!address.empty() && status.error_code() == grpc::StatusCode::DEADLINE_EXCEEDED) {
    message = fmt::format("kcsd at {} took too long to answer: {}", address, message);
  }
  throw Error(code_name(status.error_code()), message, violations_of(status));
}

bool is_lost(const grpc::Status& status) {
  switch (status.error_code()) {
    case grpc::StatusCode::UNAVAILABLE:
    case grpc::StatusCode::CANCELLED:
    case grpc::StatusCode::UNKNOWN:
      return true;
    default:
      return false;
  }
}

}  // namespace kcs::client
