// The whole planning service in one object: the planning threads, the store of plans, and the gRPC server in front.
#pragma once

#include <grpcpp/channel.h>
#include <grpcpp/server_builder.h>
#include <kcs/v1/planning.pb.h>

#include <chrono>
#include <cstddef>
#include <map>
#include <memory>
#include <string>

#include "server/observe/log.h"
#include "server/service/caps.h"
#include "server/service/connections.h"
#include "server/service/observe_settings.h"
#include "server/service/security.h"
#include "server/store/settings.h"

namespace kcs::service {

struct ServerOptions {
  // "HOST:PORT" (port 0: any free one), "unix:PATH", "systemd" (the sockets that systemd hands over), or empty: no
  // socket at all, only in_process_channel().
  std::string listen = "127.0.0.1:50551";
  // Threads that plan; 0: one for each processor. The plans do not depend on it.
  std::size_t planning_threads = 0;
  Caps caps;
  store::StoreSettings store;
  ObserveSettings observe;
  SecuritySettings security;
  ConnectionSettings connections;
  // Machines that requests over HTTP may name.
  std::map<std::string, v1::Machine> machines;
  // Where it logs to.
  observe::Log log;
};

// Serves from construction until stop() or destruction. Its methods may be called from any thread.
class Server {
 public:
  // Throws std::runtime_error, with the address and the remedy, if it cannot listen there or would let strangers in.
  explicit Server(const ServerOptions& options);
  // Stops without grace.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  // Where clients reach it, with the port that was really taken; empty without a socket.
  const std::string& address() const;

  // Where its figures are asked for over HTTP, with the port that was really taken; empty if nowhere.
  std::string http_address() const;

  // A channel to this server that needs no socket. Close its calls before the server goes.
  std::shared_ptr<grpc::Channel> in_process_channel();

  // Refuses new requests, lets the running ones finish for up to `grace`, then cancels them. Returns when they have
  // ended, at the latest three seconds after the grace: a call whose client takes nothing from its connection may still
  // hang then, a thread may still be making a plan, and the database may not have answered. The destructor waits for
  // all of them. Calling it again does nothing.
  void stop(std::chrono::milliseconds grace);

 private:
  struct Parts;

  void serve_address(grpc::ServerBuilder& builder, const std::string& listen);
  void serve_inherited(grpc::ServerBuilder& builder);

  std::unique_ptr<Parts> parts_;
};

}  // namespace kcs::service
