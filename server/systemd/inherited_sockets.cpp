#include "server/systemd/inherited_sockets.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <systemd/sd-daemon.h>

#include <stdexcept>

#include "server/net/address.h"

namespace kcs::systemd {
namespace {

std::string address_of(int descriptor) {
  sockaddr_storage address{};
  socklen_t size = sizeof(address);
  getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size);
  if (const auto numbers = net::host_port_of(address)) return net::to_string(*numbers);
  return std::string("unix:") + reinterpret_cast<const sockaddr_un&>(address).sun_path;
}

}  // namespace

std::vector<InheritedSocket> inherited_sockets() {
  const int count = sd_listen_fds(0);
  if (count <= 0) {
    throw std::runtime_error(
        "systemd handed over no socket: start the program by its .socket unit, or let it listen "
        "on HOST:PORT");
  }
  std::vector<InheritedSocket> sockets;
  for (int descriptor = SD_LISTEN_FDS_START; descriptor < SD_LISTEN_FDS_START + count; ++descriptor) {
    if (sd_is_socket(descriptor, AF_UNSPEC, SOCK_STREAM, 1) <= 0) {
      throw std::runtime_error(
          "systemd handed over something else than a listening stream socket: give the .socket "
          "unit ListenStream= alone, and Accept=no");
    }
    sockets.push_back({descriptor, address_of(descriptor)});
  }
  return sockets;
}

}  // namespace kcs::systemd
