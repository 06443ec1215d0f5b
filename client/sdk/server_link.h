// The way to a server, as every kind of call needs it. Used inside kcs alone.
#pragma once

#include <grpcpp/channel.h>
#include <grpcpp/client_context.h>
#include <grpcpp/support/status.h>

#include <memory>
#include <stop_token>
#include <string>

#include "client/sdk/connection.h"

namespace kcs::client {

// Safe for use by many threads at once.
class ServerLink {
 public:
  // Without an address: the channel leads to a server inside the process, which is always there.
  explicit ServerLink(std::shared_ptr<grpc::Channel> channel, Connection server = {});

  const std::shared_ptr<grpc::Channel>& channel() const { return channel_; }
  const Connection& connection() const { return server_; }
  const std::string& address() const { return server_.address; }

  // Waits until the server can be reached. Throws Error: "UNAVAILABLE" if it cannot, at once if it refuses the
  // connection, when the patience is over if it does not answer; "CANCELLED" after a stop.
  void await_server(const std::stop_token& stop) const;

  // Throws the Error of a call that failed.
  void check(const grpc::Status& status) const;

  // For questions that a server answers at once.
  void set_deadline(grpc::ClientContext& context) const;

 private:
  bool changes_from(grpc_connectivity_state state) const;
  std::string reason() const;

  std::shared_ptr<grpc::Channel> channel_;
  Connection server_;
};

}  // namespace kcs::client
