// Sends a token with every call. Used inside the library alone.
#pragma once

#include <grpcpp/security/credentials.h>

#include <filesystem>
#include <memory>

namespace kcs::client {

// The token is the first line of `file`, which is read for each call; if that cannot be done, the call fails as
// UNAVAILABLE. Throws std::system_error or Error ("INVALID_ARGUMENT") if it cannot be done now.
// needs_tls: whether gRPC is to refuse it to every channel without TLS.
std::shared_ptr<grpc::CallCredentials> token_credentials(const std::filesystem::path& file, bool needs_tls);

}  // namespace kcs::client
