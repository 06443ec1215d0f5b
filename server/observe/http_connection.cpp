#include "server/observe/http_connection.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>

#include "server/net/address.h"

namespace kcs::observe {
namespace {

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
  shutdown(socket_, SHUT_RDWR);
  close(socket_);
}

bool HttpConnection::is_readable() const { return wait_for(POLLIN); }

bool HttpConnection::is_writable() const { return wait_for(POLLOUT); }

ssize_t HttpConnection::read(char* bytes, std::size_t size) {
  if (!is_readable()) return -1;
  const ssize_t count = recv(socket_, bytes, std::min(size, bytes_left_), MSG_DONTWAIT);
  if (count > 0) bytes_left_ -= static_cast<std::size_t>(count);
  return count;  // nothing where too much was sent: to the library the request ends here
}

ssize_t HttpConnection::write(const char* bytes, std::size_t size) {
  return is_writable() ? send(socket_, bytes, size, MSG_DONTWAIT | MSG_NOSIGNAL) : -1;
}

void HttpConnection::get_remote_ip_and_port(std::string& ip, int& port) const {
  put_address(socket_, getpeername, ip, port);
}

void HttpConnection::get_local_ip_and_port(std::string& ip, int& port) const {
  put_address(socket_, getsockname, ip, port);
}

bool HttpConnection::wait_for(short events) const {
  using std::chrono::milliseconds;
  const auto left = std::chrono::ceil<milliseconds>(end_ - std::chrono::steady_clock::now());
  pollfd wanted{.fd = socket_, .events = events, .revents = 0};
  return left.count() > 0 && poll(&wanted, 1, static_cast<int>(left.count())) == 1;
}

}  // namespace kcs::observe
