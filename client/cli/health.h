// Whether a server takes requests: what a container's health check asks.
#pragma once

#include <string>

namespace kcs::cli {

// Asks /readyz of the kcsd whose HTTP is at `address` ("HOST:PORT"), and prints what it says. It asks HTTP and not
// gRPC, because it then needs neither certificates nor a token. Throws client::Error: "UNAVAILABLE" if the server does
// not answer within five seconds or is not ready, with its reason.
void check_health(const std::string& address);

}  // namespace kcs::cli
