// From a gRPC status to an Error. Used inside the library alone.
#pragma once

#include <grpcpp/support/status.h>

#include <string>

namespace kcs::client {

// Throws the Error that `status` stands for, with the field violations in its details. `address` is where the server
// was sought, empty for one inside the process; it is named if nobody answered there. `status` must not be OK.
[[noreturn]] void throw_error(const grpc::Status& status, const std::string& address);

// Whether a call that nobody asked to end was lost with its server, so that another one may answer. One behind a
// balancer that dies ends them as CANCELLED or UNKNOWN, which kcsd never answers to a client that waits.
bool is_lost(const grpc::Status& status);

}  // namespace kcs::client
