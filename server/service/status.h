// How a call ends, as the client sees it.
#pragma once

#include <grpcpp/support/status.h>

#include <stdexcept>
#include <string>

namespace kcs::service {

struct CallEnd {
  grpc::Status status;
  std::string cap = {};     // for which it was refused; empty if it was not for one
  std::string reason = {};  // for the log alone; empty if the status says all
};

// The end that the exception being handled brings; call it inside a catch clause only.
//   planning::InvalidInput   INVALID_ARGUMENT with a google.rpc.BadRequest in the status details
//   jobs::CapExceeded        RESOURCE_EXHAUSTED, which names the cap; with a google.rpc.RetryInfo if that may help
//   NotKept                  NOT_FOUND
//   Unauthenticated          UNAUTHENTICATED
//   Forbidden                PERMISSION_DENIED
//   Stopping                 UNAVAILABLE with a google.rpc.RetryInfo
//   Refused                  the status that the plan was refused with
//   store::StoreUnavailable  UNAVAILABLE with a google.rpc.RetryInfo
//   store::StoreFull         RESOURCE_EXHAUSTED with a google.rpc.RetryInfo
//   Cancelled                CANCELLED
//   planning::Stopped        CANCELLED: its client has gone
//   runs::NotNow             FAILED_PRECONDITION
//   NotAttached, NoSuchRun   NOT_FOUND
//   store::MachineHasRun     FAILED_PRECONDITION
//   AlreadyAttached          ALREADY_EXISTS
//   jobs::Withdrawn          ABORTED: the plan was deleted before it was made
//   std::bad_alloc           RESOURCE_EXHAUSTED with a google.rpc.RetryInfo
//   anything else            INTERNAL with the reason: a defect of kcs
CallEnd end_by_current_exception();

// Thrown where a plan is asked for that the server does not keep, or that belongs to somebody else: which of the two it
// is, is nobody's business.
struct NotKept {};

// Thrown where something is asked of a machine, "machines/NAME", that no gateway has attached to this server.
struct NotAttached : std::runtime_error {
  explicit NotAttached(const std::string& machine)
      : std::runtime_error(machine + " is not attached to this server: is its gateway running, and connected here?") {}
};

// Thrown where a run is asked for that is not kept, or is over.
struct NoSuchRun : std::runtime_error {
  explicit NoSuchRun(const std::string& run) : std::runtime_error("there is no such run: \"" + run + "\"") {}
};

// Thrown where a second gateway wants a machine. what() names it.
struct AlreadyAttached : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Thrown where nobody knows who calls. what() says what to send; never a token.
struct Unauthenticated : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Thrown where somebody calls what he may not. what() names the role that he needs.
struct Forbidden : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Thrown where a plan is asked for that was refused, after it was accepted without waiting for it.
struct Refused {
  grpc::Status status;
};

// A status as it is kept, until Refused carries it to those who ask.
std::string encode_refusal(const grpc::Status& status);
grpc::Status decode_refusal(const std::string& bytes);

// Thrown where a call comes after the server was told to stop.
struct Stopping {};

// Thrown where a call goes on whose client is gone.
struct Cancelled {};

}  // namespace kcs::service
