// By what name a call is found in the log.
#pragma once

#include <grpcpp/server_context.h>

#include <string>

namespace kcs::service {

// Metadata that carries a call's id in both directions.
inline constexpr const char* kRequestIdKey = "x-request-id";

// The id that the client gave the call, if it is 1 to 128 letters, digits and "-._:/+=@"; else 32 random hexadecimal
// digits.
std::string request_id_of(const grpc::ServerContext& context);

}  // namespace kcs::service
