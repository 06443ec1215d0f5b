#include "tests/system/free_port.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <stdexcept>
#include <string>

namespace kcs::test {
namespace {

// By a name among the sockets of this computer that have no file. It stays taken until this process ends.
bool reserve(int port) {
  const std::string name = "kcs-test-port-" + std::to_string(port);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::copy(name.begin(), name.end(), address.sun_path + 1);  // after a zero
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  const int holder = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (bind(holder, reinterpret_cast<const sockaddr*>(&address), size) == 0) return true;
  close(holder);
  return false;
}

}  // namespace

int free_port() {
  std::random_device random;
  std::uniform_int_distribution ports(10'000, 30'000);
  for (int attempt = 0; attempt < 100; ++attempt) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(ports(random)));
    const int probe = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const bool is_free = bind(probe, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
    close(probe);
    if (is_free && reserve(ntohs(address.sin_port))) return ntohs(address.sin_port);
  }
  throw std::runtime_error("no port is free");
}

}  // namespace kcs::test
