// Where a call comes from.
#pragma once

#include <grpcpp/server_context.h>

#include <string>

namespace kcs::service {

// The address of the call's client as gRPC spells it, "ipv4:192.0.2.7:51234": that of the request over HTTP for which
// this process makes the call itself.
std::string peer_of(const grpc::ServerContext& context);

}  // namespace kcs::service
