// Sockets that systemd listens on for a service and hands to it when it starts it. See sd_listen_fds(3).
#pragma once

#include <string>
#include <vector>

namespace kcs::systemd {

struct InheritedSocket {
  int descriptor;       // of a stream socket that listens; whoever takes it closes it
  std::string address;  // "HOST:PORT" or "unix:PATH"
};

// At least one. Throws std::runtime_error, with the remedy, if there is none or one that is something else.
std::vector<InheritedSocket> inherited_sockets();

}  // namespace kcs::systemd
