#include "tests/rpc/refusals.h"

namespace kcs::test {

std::vector<std::string> violations(const grpc::Status& status) {
  std::vector<std::string> list;
  const auto refused = detail<google::rpc::BadRequest>(status);
  for (const auto& violation : refused.field_violations()) {
    list.push_back(violation.field() + ": " + violation.description());
  }
  return list;
}

::testing::AssertionResult refuses_field(const grpc::Status& status, const std::string& field) {
  if (status.error_code() != grpc::StatusCode::INVALID_ARGUMENT) {
    return ::testing::AssertionFailure() << "status " << status.error_code() << ": " << status.error_message();
  }
  auto failure = ::testing::AssertionFailure() << "no violation of \"" << field << "\" among:";
  for (const std::string& violation : violations(status)) {
    if (violation.starts_with(field + ": ") && violation.size() > field.size() + 2) {
      return ::testing::AssertionSuccess();
    }
    failure << "\n  " << violation;
  }
  return failure;
}

::testing::AssertionResult tells_when_to_try_again(const grpc::Status& status) {
  if (find_detail<google::rpc::RetryInfo>(status)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "no RetryInfo: " << status.error_code() << " " << status.error_message();
}

::testing::AssertionResult is_unavailable_for_a_while(const grpc::Status& status) {
  if (status.error_code() == grpc::StatusCode::UNAVAILABLE) return tells_when_to_try_again(status);
  return ::testing::AssertionFailure() << "status " << status.error_code() << " " << status.error_message();
}

}  // namespace kcs::test
