// Which machine a call is about, for a balancer between clients and several servers.
#pragma once

#include <grpcpp/client_context.h>

#include <string>

namespace kcs::client {

// Has the call say in its metadata, as kcs-machine, which machine `name` is ("machines/mill"), or is a run of
// ("machines/mill/runs/7"). A balancer that sends all calls with the same key to the same server brings them to the one
// that the machine's gateway is attached to. Servers do not look at it.
inline void say_machine(grpc::ClientContext& context, const std::string& name) {
  context.AddMetadata("kcs-machine", name.substr(0, name.find("/runs/")));
}

}  // namespace kcs::client
