// What a server says of a call that it refuses.
#pragma once

#include <google/rpc/error_details.pb.h>
#include <grpcpp/support/status.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

namespace kcs::test {

// The detail of this kind in a failure's status; nothing without one.
template <typename Detail>
std::optional<Detail> find_detail(const grpc::Status& status) {
  google::rpc::Status details;
  details.ParseFromString(status.error_details());
  for (const google::protobuf::Any& any : details.details()) {
    if (Detail found; any.UnpackTo(&found)) return found;
  }
  return {};
}

// The same; an empty one if there is none.
template <typename Detail>
Detail detail(const grpc::Status& status) {
  return find_detail<Detail>(status).value_or(Detail());
}

// "field: description" of each violation in a refusal.
std::vector<std::string> violations(const grpc::Status& status);
// The refusal is INVALID_ARGUMENT and one of its violations is of just this field.
::testing::AssertionResult refuses_field(const grpc::Status& status, const std::string& field);

::testing::AssertionResult tells_when_to_try_again(const grpc::Status& status);
// UNAVAILABLE, and when it is worth to try again.
::testing::AssertionResult is_unavailable_for_a_while(const grpc::Status& status);

}  // namespace kcs::test
