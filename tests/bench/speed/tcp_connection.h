// What a stream of setpoints over gRPC is compared with.
#pragma once

#include <cstddef>

namespace kcs::bench {

// A TCP connection over loopback, with both of its ends.
class TcpConnection {
 public:
  // Throws std::system_error if there can be none.
  TcpConnection();
  ~TcpConnection();
  TcpConnection(const TcpConnection&) = delete;
  TcpConnection& operator=(const TcpConnection&) = delete;

  // Moves so many bytes from one end, in a thread of its own, to the other; returns when the last has arrived.
  void transfer(std::size_t bytes);

 private:
  int from_ = -1, to_ = -1;
};

}  // namespace kcs::bench
