// Takes connections from sockets that somebody else listens on, and hands them to gRPC.
#pragma once

#include <grpcpp/server_builder.h>

#include <memory>
#include <thread>
#include <vector>

namespace kcs::service {

// gRPC cannot take over a listening socket, but connections. Accepts them from construction to destruction; what comes
// afterwards waits in the socket for the next one who listens.
class SocketAcceptor {
 public:
  // sockets: file descriptors of listening stream sockets; closes them in the end. `server` must serve by now.
  SocketAcceptor(std::vector<int> sockets, std::unique_ptr<grpc::experimental::ExternalConnectionAcceptor> server);
  ~SocketAcceptor();
  SocketAcceptor(const SocketAcceptor&) = delete;
  SocketAcceptor& operator=(const SocketAcceptor&) = delete;

 private:
  void run();
  void accept_from(int socket);

  const std::vector<int> sockets_;
  const std::unique_ptr<grpc::experimental::ExternalConnectionAcceptor> server_;
  const int stop_;  // an eventfd, readable once this ends
  std::thread thread_;
};

}  // namespace kcs::service
