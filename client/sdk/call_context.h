// The context of a call that can be stopped. Used inside the library alone.
#pragma once

#include <grpcpp/client_context.h>

#include <stop_token>

namespace kcs::client {

// Makes its call end with CANCELLED when a stop is requested, at once if that was before the call began.
class CallContext : public grpc::ClientContext {
 public:
  explicit CallContext(const std::stop_token& stop) : cancel_(stop, Cancel{*this}) {}

 private:
  struct Cancel {
    grpc::ClientContext& context;
    void operator()() const { context.TryCancel(); }
  };
  std::stop_callback<Cancel> cancel_;
};

}  // namespace kcs::client
