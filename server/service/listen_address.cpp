#include "server/service/listen_address.h"

#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cstring>
#include <memory>
#include <stdexcept>
#include <utility>

#include "server/net/address.h"
#include "server/systemd/inherited_sockets.h"

namespace kcs::service {
namespace {

bool is_loopback(const sockaddr& address) {
  if (address.sa_family == AF_INET) {
    const auto& four = reinterpret_cast<const sockaddr_in&>(address);
    return ntohl(four.sin_addr.s_addr) >> 24 == IN_LOOPBACKNET;
  }
  const auto& six = reinterpret_cast<const sockaddr_in6&>(address);
  return IN6_IS_ADDR_LOOPBACK(&six.sin6_addr);
}

std::vector<SocketAddress> resolve(const std::string& listen, const net::HostPort& wanted) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* list = nullptr;
  const std::string port = std::to_string(wanted.port);
  if (const int failed = getaddrinfo(wanted.host.c_str(), port.c_str(), &hints, &list); failed != 0) {
    throw std::runtime_error("cannot listen on " + listen + ": " + gai_strerror(failed) +
                             "; give an address of this machine");
  }
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> owner(list, &freeaddrinfo);
  std::vector<SocketAddress> addresses;
  for (const addrinfo* entry = list; entry != nullptr; entry = entry->ai_next) {
    sockaddr_storage storage{};
    std::memcpy(&storage, entry->ai_addr, entry->ai_addrlen);
    if (const auto numbers = net::host_port_of(storage)) {
      addresses.push_back({.text = net::to_string(*numbers), .local = is_loopback(*entry->ai_addr)});
    }
  }
  return addresses;
}

std::vector<SocketAddress> inherited() {
  std::vector<SocketAddress> addresses;
  for (const systemd::InheritedSocket& socket : systemd::inherited_sockets()) {
    for (SocketAddress& address : socket_addresses(socket.address)) addresses.push_back(std::move(address));
  }
  return addresses;
}

}  // namespace

bool is_unix(const std::string& listen) { return listen.starts_with("unix:"); }

std::vector<SocketAddress> socket_addresses(const std::string& listen) {
  if (listen == kSystemd) return inherited();
  if (is_unix(listen)) return {{.text = listen, .local = true}};
  const auto address = net::parse_host_port(listen);
  if (!address) {
    throw std::runtime_error("cannot listen on \"" + listen +
                             "\": give HOST:PORT, with a port up to 65535, or unix:PATH");
  }
  return resolve(listen, *address);
}

}  // namespace kcs::service
