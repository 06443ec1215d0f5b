#include "server/service/socket_acceptor.h"

#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <system_error>
#include <utility>

namespace kcs::service {
namespace {

// How long it waits where a connection could not be accepted, for lack of file descriptors mostly.
constexpr std::chrono::milliseconds kBackOff{50};

int new_event() {
  const int descriptor = eventfd(0, EFD_CLOEXEC);
  if (descriptor < 0) throw std::system_error(errno, std::generic_category(), "eventfd");
  return descriptor;
}

}  // namespace

SocketAcceptor::SocketAcceptor(std::vector<int> sockets,
                               std::unique_ptr<grpc::experimental::ExternalConnectionAcceptor> server)
    : sockets_(std::move(sockets)), server_(std::move(server)), stop_(new_event()) {
  // Between poll() and accept() a connection may vanish: accept() must not wait for the next one then.
  for (const int socket : sockets_) fcntl(socket, F_SETFL, fcntl(socket, F_GETFL) | O_NONBLOCK);
  thread_ = std::thread([this] { run(); });
}

SocketAcceptor::~SocketAcceptor() {
  eventfd_write(stop_, 1);
  thread_.join();
  close(stop_);
  for (const int socket : sockets_) close(socket);
}

void SocketAcceptor::run() {
  std::vector<pollfd> watched = {{.fd = stop_, .events = POLLIN, .revents = 0}};
  for (const int socket : sockets_) watched.push_back({.fd = socket, .events = POLLIN, .revents = 0});
  while (true) {
    poll(watched.data(), watched.size(), -1);
    if (watched[0].revents != 0) return;
    for (const pollfd& ready : watched) {
      if (ready.revents != 0) accept_from(ready.fd);
    }
  }
}

void SocketAcceptor::accept_from(int socket) {
  const int connection = accept4(socket, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (connection < 0) {
    if (errno != EAGAIN && errno != EINTR && errno != ECONNABORTED) std::this_thread::sleep_for(kBackOff);
    return;
  }
  const int yes = 1;  // as gRPC does on its own connections; fails where this is no TCP
  setsockopt(connection, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof(yes));
  grpc::experimental::ExternalConnectionAcceptor::NewConnectionParameters parameters;
  parameters.listener_fd = socket;
  parameters.fd = connection;
  server_->HandleNewConnection(&parameters);
}

}  // namespace kcs::service
