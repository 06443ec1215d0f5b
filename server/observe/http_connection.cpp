#include "server/observe/http_connection.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <limits>

#include "server/net/address.h"

namespace kcs::observe {
namespace {

constexpr int kBodyBytesPerSecond = 65536;
constexpr std::chrono::milliseconds kFarewell{500};

// What getpeername() and getsockname() are for.
using AskAddress = int (*)(int socket, sockaddr* address, socklen_t* size);

void put_address(int socket, AskAddress ask, std::string& ip, int& port) {
  sockaddr_storage address{};
  socklen_t size = sizeof(address);
  if (ask(socket, reinterpret_cast<sockaddr*>(&address), &size) != 0) return;
  if (const auto numbers = net::host_port_of(address)) {
    ip = numbers->host;
    port = numbers->port;
  }
}

}  // namespace

HttpConnection::~HttpConnection() {
  if (late_answer_) let_client_read();
  shutdown(socket_, SHUT_RDWR);
  close(socket_);
}

bool HttpConnection::is_readable() const { return wait_for(POLLIN); }

bool HttpConnection::is_writable() const { return wait_for(POLLOUT); }

ssize_t HttpConnection::read(char* bytes, std::size_t size) {
  if (!is_readable()) return -1;
  const ssize_t count = recv(socket_, bytes, std::min(size, bytes_left_), MSG_DONTWAIT);
  if (count > 0) {
    bytes_left_ -= static_cast<std::size_t>(count);
    end_ += count * time_per_byte_;
  }
  return count;  // nothing where too much was sent: to the library the request ends here
}

ssize_t HttpConnection::write(const char* bytes, std::size_t size) {
  if (late_answer_ && !answers_) {
    answers_ = true;
    end_ = std::chrono::steady_clock::now() + patience_;
  }
  return is_writable() ? send(socket_, bytes, size, MSG_DONTWAIT | MSG_NOSIGNAL) : -1;
}

void HttpConnection::get_remote_ip_and_port(std::string& ip, int& port) const {
  put_address(socket_, getpeername, ip, port);
}

void HttpConnection::get_local_ip_and_port(std::string& ip, int& port) const {
  put_address(socket_, getsockname, ip, port);
}

void HttpConnection::allow_body() {
  bytes_left_ = std::numeric_limits<std::size_t>::max();
  time_per_byte_ = std::chrono::nanoseconds(std::chrono::seconds(1)) / kBodyBytesPerSecond;
}

bool HttpConnection::client_waits() const {
  pollfd gone{.fd = socket_, .events = POLLRDHUP, .revents = 0};
  return poll(&gone, 1, 0) == 0;
}

// A connection that is closed while something came that nobody read is reset, and the client may lose the answer.
void HttpConnection::let_client_read() const {
  shutdown(socket_, SHUT_WR);
  std::array<char, 4096> dropped;
  const auto end = std::chrono::steady_clock::now() + kFarewell;
  pollfd readable{.fd = socket_, .events = POLLIN, .revents = 0};
  while (std::chrono::steady_clock::now() < end && poll(&readable, 1, static_cast<int>(kFarewell.count())) == 1 &&
         recv(socket_, dropped.data(), dropped.size(), MSG_DONTWAIT) > 0) {
  }
}

bool HttpConnection::wait_for(short events) const {
  using std::chrono::milliseconds;
  const auto left = std::chrono::ceil<milliseconds>(end_ - std::chrono::steady_clock::now());
  pollfd wanted{.fd = socket_, .events = events, .revents = 0};
  return left.count() > 0 && poll(&wanted, 1, static_cast<int>(left.count())) == 1;
}

}  // namespace kcs::observe
