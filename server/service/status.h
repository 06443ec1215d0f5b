// What a failure looks like to the client.
#pragma once

#include <grpcpp/support/status.h>

#include <string_view>

namespace kcs::service {

// The status for the exception that is being handled; call it inside a catch clause only. Logs it, with the method.
//   planning::InvalidInput   INVALID_ARGUMENT with a google.rpc.BadRequest in the status details
//   jobs::CapExceeded        RESOURCE_EXHAUSTED, which names the cap
//   NotKept                  NOT_FOUND
//   Stopping                 UNAVAILABLE
//   Cancelled                CANCELLED
//   std::future_error        UNAVAILABLE: the server stopped before the plan was made
//   std::bad_alloc           RESOURCE_EXHAUSTED
//   anything else            INTERNAL with the reason: a defect of kcs
grpc::Status status_of_current_exception(std::string_view method);

// Thrown where a plan is asked for that the server does not keep.
struct NotKept {};

// Thrown where a call comes after the server was told to stop.
struct Stopping {};

// Thrown where a call goes on whose client is gone.
struct Cancelled {};

}  // namespace kcs::service
