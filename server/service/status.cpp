#include "server/service/status.h"

#include <google/rpc/error_details.pb.h>
#include <spdlog/spdlog.h>

#include <array>
#include <exception>
#include <future>
#include <new>
#include <string>
#include <utility>

#include "server/jobs/cap_exceeded.h"
#include "server/planning/invalid_input.h"
#include "server/service/printable.h"

namespace kcs::service {
namespace {

// A trailer may have 8 KiB by default, base64 and the plain message included.
constexpr std::size_t kMostDetailBytes = 4096;
constexpr std::size_t kMostTextBytes = 400;

// The planner's names of fields that the contract calls by others.
constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kFields = {
    {{"path, start_speed", "options.start_speed_mm_s"},
     {"path, start_acceleration", "options.start_acceleration_mm_s2"},
     {"path, end_speed", "options.end_speed_mm_s"}}};

constexpr std::string_view kStopping = "the server is stopping; try again later";

std::string_view contract_name(std::string_view field) {
  for (const auto& [name, contract_name] : kFields) {
    if (field == name) return contract_name;
  }
  return field;
}

grpc::Status bad_request(const planning::InvalidInput& refused) {
  google::rpc::BadRequest details;
  for (const planning::Violation& violation : refused.violations()) {
    auto& entry = *details.add_field_violations();
    entry.set_field(printable(contract_name(violation.field), kMostTextBytes));
    entry.set_description(printable(violation.description, kMostTextBytes));
    if (details.ByteSizeLong() > kMostDetailBytes) {
      details.mutable_field_violations()->RemoveLast();
      break;
    }
  }
  google::rpc::Status status;
  status.set_code(grpc::StatusCode::INVALID_ARGUMENT);
  const planning::Violation& first = refused.violations().front();
  status.set_message(printable(std::string(contract_name(first.field)) + ": " + first.description, kMostTextBytes));
  status.add_details()->PackFrom(details);
  return {grpc::StatusCode::INVALID_ARGUMENT, status.message(), status.SerializeAsString()};
}

grpc::Status failure(grpc::StatusCode code, std::string_view reason) {
  return {code, printable(reason, kMostTextBytes)};
}

}  // namespace

grpc::Status status_of_current_exception(std::string_view method) {
  const auto classify = []() -> grpc::Status {
    try {
      throw;
    } catch (const planning::InvalidInput& refused) {
      return bad_request(refused);
    } catch (const jobs::CapExceeded& refused) {
      return failure(grpc::StatusCode::RESOURCE_EXHAUSTED, refused.what());
    } catch (const NotKept&) {
      return failure(
          grpc::StatusCode::NOT_FOUND,
          "the server does not keep this plan; send its request again: the same request gives the same plan");
    } catch (const Stopping&) {
      return failure(grpc::StatusCode::UNAVAILABLE, kStopping);
    } catch (const Cancelled&) {
      return failure(grpc::StatusCode::CANCELLED, "the client gave up");
    } catch (const std::future_error&) {
      return failure(grpc::StatusCode::UNAVAILABLE, kStopping);
    } catch (const std::bad_alloc&) {
      return failure(grpc::StatusCode::RESOURCE_EXHAUSTED, "the server is out of memory; try again later");
    } catch (const std::exception& defect) {
      return failure(grpc::StatusCode::INTERNAL, defect.what());
    } catch (...) {
      return failure(grpc::StatusCode::INTERNAL, "unknown failure");
    }
  };
  grpc::Status status = classify();
  if (status.error_code() == grpc::StatusCode::INTERNAL) {
    spdlog::error("{} failed: {}", method, status.error_message());
  } else {
    spdlog::info("{} refused: {}", method, status.error_message());
  }
  return status;
}

}  // namespace kcs::service
