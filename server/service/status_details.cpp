#include "server/service/status_details.h"

#include <google/protobuf/util/time_util.h>
#include <google/rpc/error_details.pb.h>

namespace kcs::service {

grpc::Status with_detail(const grpc::Status& status, const google::protobuf::Message& detail) {
  google::rpc::Status details;
  details.ParseFromString(status.error_details());
  details.set_code(status.error_code());
  details.set_message(status.error_message());
  details.add_details()->PackFrom(detail);
  return {status.error_code(), status.error_message(), details.SerializeAsString()};
}

grpc::Status with_request_id(const grpc::Status& status, const std::string& id) {
  google::rpc::RequestInfo info;
  info.set_request_id(id);
  return with_detail(status, info);
}

grpc::Status with_retry(const grpc::Status& status, std::chrono::milliseconds delay) {
  google::rpc::RetryInfo info;
  *info.mutable_retry_delay() = google::protobuf::util::TimeUtil::MillisecondsToDuration(delay.count());
  return with_detail(status, info);
}

}  // namespace kcs::service
