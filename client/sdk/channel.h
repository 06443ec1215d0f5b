// The gRPC channel of a connection. Used inside the library alone.
#pragma once

#include <grpcpp/channel.h>

#include <memory>

#include "client/sdk/connection.h"

namespace kcs::client {

// Does not connect yet. Throws std::system_error if a file cannot be read, Error ("INVALID_ARGUMENT") if the connection
// contradicts itself, or would show its token to whoever listens on the network.
std::shared_ptr<grpc::Channel> open_channel(const Connection& connection);

}  // namespace kcs::client
