#include "tests/bench/speed/tcp_connection.h"

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <thread>
#include <vector>

namespace kcs::bench {
namespace {

constexpr std::size_t kPiece = 96 << 10;  // bytes handed to the kernel at a time

template <class Result>
Result checked(Result result, const char* call) {
  if (result < 0) throw std::system_error(errno, std::generic_category(), call);
  return result;
}

}  // namespace

TcpConnection::TcpConnection() {
  sockaddr_in address{.sin_family = AF_INET, .sin_addr = {htonl(INADDR_LOOPBACK)}};
  socklen_t size = sizeof address;
  auto* const any = reinterpret_cast<sockaddr*>(&address);
  const int listener = checked(socket(AF_INET, SOCK_STREAM, 0), "socket");
  checked(bind(listener, any, size), "bind");
  checked(listen(listener, 1), "listen");
  checked(getsockname(listener, any, &size), "getsockname");
  from_ = checked(socket(AF_INET, SOCK_STREAM, 0), "socket");
  checked(connect(from_, any, size), "connect");
  to_ = checked(accept(listener, nullptr, nullptr), "accept");
  close(listener);
}

TcpConnection::~TcpConnection() {
  close(from_);
  close(to_);
}

void TcpConnection::transfer(std::size_t bytes) {
  const std::jthread sender([this, bytes] {
    const std::vector<char> piece(kPiece, 'x');
    for (std::size_t left = bytes; left > 0;) {
      left -= static_cast<std::size_t>(checked(send(from_, piece.data(), std::min(left, kPiece), 0), "send"));
    }
  });
  std::vector<char> piece(kPiece);
  for (std::size_t left = bytes; left > 0;) {
    left -= static_cast<std::size_t>(checked(recv(to_, piece.data(), std::min(left, kPiece), 0), "recv"));
  }
}

}  // namespace kcs::bench
