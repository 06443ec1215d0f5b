// Where a server listens: "HOST:PORT", "unix:PATH", or "systemd" for the sockets that systemd hands over.
#pragma once

#include <string>
#include <vector>

namespace kcs::service {

// An address for one socket, and whether only this machine reaches it.
struct SocketAddress {
  std::string text;  // "127.0.0.1:50551", "[::1]:50551", "unix:PATH"
  bool local = false;
};

inline constexpr const char* kSystemd = "systemd";

bool is_unix(const std::string& listen);

// The sockets that `listen` stands for; a host name may stand for several. Throws std::runtime_error with the remedy if
// it is of neither form, or if nobody knows the host.
std::vector<SocketAddress> socket_addresses(const std::string& listen);

}  // namespace kcs::service
