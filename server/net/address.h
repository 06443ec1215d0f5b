// Addresses as people write them.
#pragma once

#include <sys/socket.h>

#include <optional>
#include <string>

namespace kcs::net {

struct HostPort {
  std::string host;  // a name or a number; IPv6 without its brackets
  int port;          // 0 to 65535
};

// "HOST:PORT" or "[IPV6]:PORT"; nothing if it is neither.
std::optional<HostPort> parse_host_port(const std::string& address);

// The numbers of an Internet address; nothing if it is another kind of address.
std::optional<HostPort> host_port_of(const sockaddr_storage& address);

// As parse_host_port() reads it.
std::string to_string(const HostPort& address);

}  // namespace kcs::net
