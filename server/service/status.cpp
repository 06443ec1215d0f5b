#include "server/service/status.h"

#include <google/rpc/error_details.pb.h>

#include <array>
#include <chrono>
#include <exception>
#include <new>
#include <string>
#include <utility>

#include "server/jobs/cap_exceeded.h"
#include "server/jobs/withdrawn.h"
#include "server/planning/invalid_input.h"
#include "server/planning/stopped.h"
#include "server/runs/not_now.h"
#include "server/service/printable.h"
#include "server/service/status_details.h"
#include "server/store/errors.h"

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
constexpr std::string_view kNoStore = "the server cannot reach its store; try again later";
constexpr std::string_view kStoreFull = "the disk of the server's store is full; its operator must make room";
constexpr std::string_view kNotKept =
    "the server does not keep this plan; send its request again: the same request gives the same plan";
constexpr std::string_view kStoreBroken = "the server's store needs its operator; the log says why";
constexpr std::string_view kGone = "the client gave up";
// When another replica, or the next start of this one, may answer.
constexpr std::chrono::seconds kStoppingRetry{1};
// When an operator may have made room.
constexpr std::chrono::seconds kStoreRetry{60};
// When memory that is taken may be free again.
constexpr std::chrono::seconds kMemoryRetry{5};

std::string_view contract_name(std::string_view field) {
  for (const auto& [name, contract_name] : kFields) {
    if (field == name) return contract_name;
  }
  return field;
}

grpc::Status failure(grpc::StatusCode code, std::string_view reason) {
  return {code, printable(reason, kMostTextBytes)};
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
  const planning::Violation& first = refused.violations().front();
  const std::string reason = std::string(contract_name(first.field)) + ": " + first.description;
  return with_detail(failure(grpc::StatusCode::INVALID_ARGUMENT, reason), details);
}

CallEnd cap_exceeded(const jobs::CapExceeded& refused) {
  const grpc::Status status = failure(grpc::StatusCode::RESOURCE_EXHAUSTED, refused.what());
  return {refused.retry_after() ? with_retry(status, *refused.retry_after()) : status, std::string(refused.cap())};
}

grpc::Status stopping() { return with_retry(failure(grpc::StatusCode::UNAVAILABLE, kStopping), kStoppingRetry); }

}  // namespace

std::string encode_refusal(const grpc::Status& status) {
  if (!status.error_details().empty()) return status.error_details();
  google::rpc::Status message;
  message.set_code(status.error_code());
  message.set_message(status.error_message());
  return message.SerializeAsString();
}

grpc::Status decode_refusal(const std::string& bytes) {
  google::rpc::Status message;
  const bool is_refusal = message.ParseFromString(bytes) && message.code() > grpc::StatusCode::OK &&
                          message.code() <= grpc::StatusCode::UNAUTHENTICATED;  // the last one of gRPC
  if (!is_refusal) return failure(grpc::StatusCode::INTERNAL, kStoreBroken);
  return {static_cast<grpc::StatusCode>(message.code()), message.message(), bytes};
}

CallEnd end_by_current_exception() {
  try {
    throw;
  } catch (const planning::InvalidInput& refused) {
    return {bad_request(refused)};
  } catch (const jobs::CapExceeded& refused) {
    return cap_exceeded(refused);
  } catch (const NotKept&) {
    return {failure(grpc::StatusCode::NOT_FOUND, kNotKept)};
  } catch (const runs::NotNow& refused) {
    return {failure(grpc::StatusCode::FAILED_PRECONDITION, refused.what())};
  } catch (const NotAttached& refused) {
    return {failure(grpc::StatusCode::NOT_FOUND, refused.what())};
  } catch (const NoSuchRun& refused) {
    return {failure(grpc::StatusCode::NOT_FOUND, refused.what())};
  } catch (const store::PlanNotKept&) {
    return {failure(grpc::StatusCode::NOT_FOUND, kNotKept)};
  } catch (const store::MachineHasRun& refused) {
    return {failure(grpc::StatusCode::FAILED_PRECONDITION, refused.what())};
  } catch (const AlreadyAttached& refused) {
    return {failure(grpc::StatusCode::ALREADY_EXISTS, refused.what())};
  } catch (const Unauthenticated& refused) {
    return {failure(grpc::StatusCode::UNAUTHENTICATED, refused.what())};
  } catch (const Forbidden& refused) {
    return {failure(grpc::StatusCode::PERMISSION_DENIED, refused.what())};
  } catch (const Stopping&) {
    return {stopping()};
  } catch (const planning::Stopped&) {
    return {failure(grpc::StatusCode::CANCELLED, kGone)};
  } catch (const Cancelled&) {
    return {failure(grpc::StatusCode::CANCELLED, kGone)};
  } catch (const Refused& refused) {
    return {refused.status};
  } catch (const store::StoreUnavailable& unavailable) {
    return {with_retry(failure(grpc::StatusCode::UNAVAILABLE, kNoStore), kStoppingRetry), {}, unavailable.what()};
  } catch (const store::StoreFull& full) {
    return {with_retry(failure(grpc::StatusCode::RESOURCE_EXHAUSTED, kStoreFull), kStoreRetry), {}, full.what()};
  } catch (const store::StoreError& broken) {
    return {failure(grpc::StatusCode::INTERNAL, kStoreBroken), {}, broken.what()};
  } catch (const jobs::Withdrawn& withdrawn) {
    return {failure(grpc::StatusCode::ABORTED, withdrawn.what())};
  } catch (const std::bad_alloc&) {
    return {with_retry(failure(grpc::StatusCode::RESOURCE_EXHAUSTED, "the server is out of memory; try again later"),
                       kMemoryRetry)};
  } catch (const std::exception& defect) {
    return {failure(grpc::StatusCode::INTERNAL, defect.what())};
  } catch (...) {
    return {failure(grpc::StatusCode::INTERNAL, "unknown failure")};
  }
}

}  // namespace kcs::service
