#include "tests/cable/cable.h"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <system_error>
#include <vector>

namespace kcs::test {
namespace {

constexpr int kLookEveryMs = 2;

sockaddr_in loopback(int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  return address;
}

[[noreturn]] void fail() { throw std::system_error(errno, std::generic_category(), "cable"); }

bool send_all(int to, const char* data, ssize_t size) {
  while (size > 0) {
    const ssize_t sent = send(to, data, static_cast<std::size_t>(size), MSG_NOSIGNAL);
    if (sent <= 0) return false;
    data += sent;
    size -= sent;
  }
  return true;
}

}  // namespace

Cable::Cable(int server_port) : server_port_(server_port), listener_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in address = loopback(0);
  socklen_t size = sizeof address;
  auto* plain = reinterpret_cast<sockaddr*>(&address);
  if (listener_ < 0 || bind(listener_, plain, size) != 0 || listen(listener_, SOMAXCONN) != 0) fail();
  if (getsockname(listener_, plain, &size) != 0) fail();
  port_ = ntohs(address.sin_port);
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

Cable::~Cable() {
  thread_.request_stop();
  thread_.join();
  close(listener_);
}

void Cable::run(const std::stop_token& stop) {
  std::vector<std::jthread> connections;
  while (!stop.stop_requested()) {
    pollfd waits = {.fd = listener_, .events = POLLIN};
    if (poll(&waits, 1, kLookEveryMs) <= 0) continue;
    const int client = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
    if (client < 0) continue;
    connections.emplace_back([this, client](const std::stop_token& ends) { connect_through(client, ends); });
  }
}

// On its way from the server.
void Cable::disturb(char* data, ssize_t size) {
  constexpr char kBit = 0x10;
  if (size > 0 && corrupts_.exchange(false)) data[size / 2] ^= kBit;
  std::this_thread::sleep_for(delay_.load());
}

void Cable::connect_through(int client, const std::stop_token& stop) {
  const int server = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const sockaddr_in address = loopback(server_port_);
  bool open = !cut_ && connect(server, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  std::array<char, 65'536> buffer{};
  const int abandoned = abandoned_;
  while (open && !cut_ && !stop.stop_requested()) {
    if (stalls_ || abandoned != abandoned_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(kLookEveryMs));
      continue;
    }
    std::array<pollfd, 2> waits = {pollfd{.fd = client, .events = POLLIN}, pollfd{.fd = server, .events = POLLIN}};
    poll(waits.data(), waits.size(), kLookEveryMs);
    for (std::size_t i = 0; i < waits.size() && open; ++i) {
      if (waits[i].revents == 0) continue;
      const ssize_t size = recv(waits[i].fd, buffer.data(), buffer.size(), 0);
      if (i == 1) disturb(buffer.data(), size);
      open = size > 0 && send_all(waits[1 - i].fd, buffer.data(), size);
    }
  }
  close(client);
  close(server);
}

}  // namespace kcs::test
