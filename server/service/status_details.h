// More about a failure than its code and a sentence: Google's standard error model.
#pragma once

#include <google/protobuf/message.h>
#include <grpcpp/support/status.h>

#include <chrono>
#include <string>

namespace kcs::service {

// The failure `status`, with one detail more. A client takes some 8 KiB of all of them: keep them short.
grpc::Status with_detail(const grpc::Status& status, const google::protobuf::Message& detail);

// With a google.rpc.RequestInfo. id: of the call.
grpc::Status with_request_id(const grpc::Status& status, const std::string& id);

// With a google.rpc.RetryInfo: trying again may help, but not before `delay` has passed.
grpc::Status with_retry(const grpc::Status& status, std::chrono::milliseconds delay);

}  // namespace kcs::service
