// Why a server cannot be reached. Used inside the library alone.
#pragma once

#include <string>
#include <string_view>

#include "client/sdk/connection.h"

namespace kcs::client {

// Puts into words what to do about a connection that failed; `reason` is what gRPC says about it.
std::string explain_no_connection(const Connection& connection, std::string_view reason);

}  // namespace kcs::client
