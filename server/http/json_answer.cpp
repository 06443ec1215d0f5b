#include "server/http/json_answer.h"

#include <absl/status/status.h>
#include <google/protobuf/reflection.h>
#include <google/rpc/error_details.pb.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace kcs::http {
namespace {

using Json = nlohmann::ordered_json;

// The numbers of a message by their names in the contract.
Json numbers_of(const google::protobuf::Message& message) {
  using Field = google::protobuf::FieldDescriptor;
  Json json = Json::object();
  const google::protobuf::Reflection& content = *message.GetReflection();
  const google::protobuf::Descriptor& type = *message.GetDescriptor();
  for (int i = 0; i < type.field_count(); ++i) {
    const Field* const field = type.field(i);
    if (field->cpp_type() == Field::CPPTYPE_UINT64) {
      json[field->name()] = content.GetUInt64(message, field);
    } else if (field->cpp_type() == Field::CPPTYPE_DOUBLE && field->is_repeated()) {
      json[field->name()] = content.GetRepeatedFieldRef<double>(message, field);
    } else if (field->cpp_type() == Field::CPPTYPE_DOUBLE) {
      json[field->name()] = content.GetDouble(message, field);
    }
  }
  return json;
}

// As google/rpc/code.proto pairs them.
int http_status_of(grpc::StatusCode code) {
  using enum grpc::StatusCode;
  switch (code) {
    case INVALID_ARGUMENT:
    case FAILED_PRECONDITION:
    case OUT_OF_RANGE:
      return 400;
    case UNAUTHENTICATED:
      return 401;
    case PERMISSION_DENIED:
      return 403;
    case NOT_FOUND:
      return 404;
    case RESOURCE_EXHAUSTED:
      return 429;
    case UNAVAILABLE:
      return 503;
    case DEADLINE_EXCEEDED:
      return 504;
    default:
      return 500;
  }
}

Json violation_json(const std::string& field, const std::string& description) {
  Json json = {{"field", field}, {"description", description}};
  unsigned line = 0;
  if (std::sscanf(field.c_str(), "gcode, line %u", &line) == 1) json["line"] = line;
  return json;
}

}  // namespace

Answer answer_of(const v1::Plan& plan, Json slow_spots) {
  Json notices = Json::array();
  for (const v1::Notice& notice : plan.notices()) {
    notices.push_back({{"line", notice.line()}, {"text", notice.text()}, {"count", notice.count()}});
  }
  Json body = {{"name", plan.name()}, {"verified", true}};  // no other plan is ever served
  body.update(numbers_of(plan.summary()));
  body["machine"] = plan.options().machine().name();
  body["tolerance_mm"] = plan.options().tolerance_mm();
  body["slow_spots"] = std::move(slow_spots);
  body["notices"] = std::move(notices);
  return {.body = std::move(body)};
}

Answer refusal(int status, const std::string& code, const std::string& message, const std::string& field) {
  Json error = {{"code", code}, {"message", message}};
  if (!field.empty()) error["violations"] = Json::array({violation_json(field, message)});
  return {.status = status, .body = {{"error", std::move(error)}}};
}

Answer answer_of(const grpc::Status& status) {
  const auto code = static_cast<absl::StatusCode>(status.error_code());  // the same numbers
  Answer answer = refusal(http_status_of(status.error_code()), absl::StatusCodeToString(code), status.error_message());
  google::rpc::Status details;
  details.ParseFromString(status.error_details());
  for (const google::protobuf::Any& detail : details.details()) {
    google::rpc::BadRequest request;
    google::rpc::RetryInfo retry;
    if (detail.UnpackTo(&request)) {
      for (const auto& violation : request.field_violations()) {
        answer.body["error"]["violations"].push_back(violation_json(violation.field(), violation.description()));
      }
    } else if (detail.UnpackTo(&retry)) {
      answer.retry_after_s = std::max<long>(1, retry.retry_delay().seconds());
    }
  }
  // A cap that time does not lift: the program itself is too large.
  if (answer.status == 429 && !answer.retry_after_s) answer.status = 413;
  return answer;
}

}  // namespace kcs::http
