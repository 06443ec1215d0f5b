#include "server/service/calls.h"

#include <algorithm>
#include <array>
#include <string>

#include "server/service/peer.h"

namespace kcs::service {
namespace {

// What somebody needs who has to stop a machine.
constexpr std::array<std::string_view, 4> kNeverRefused = {"GetRun", "HoldRun", "AbortRun", "SetFeedOverride"};

bool is_never_refused(std::string_view method) {
  return std::find(kNeverRefused.begin(), kNeverRefused.end(), method) != kNeverRefused.end();
}

// The caller, or where nobody is told apart the address that the call comes from, without its port:
// "ipv4:192.0.2.7:51234" is a client on 192.0.2.7.
jobs::Client client_of(const security::Identity& caller, const grpc::ServerContext& context) {
  if (!caller.owner.empty()) return caller.owner;
  const std::string peer = peer_of(context);
  return peer.starts_with("ip") ? peer.substr(0, peer.rfind(':')) : peer;
}

}  // namespace

Caller Calls::admit(std::string_view method, const CallRecord& call, grpc::ServerContext& context) const {
  if (closed_ && !is_never_refused(method)) throw Stopping();
  Caller caller{.identity = access_.admit(context, method), .request_id = call.request_id()};
  caller.client = client_of(caller.identity, context);
  caller.require_wanted = [this, &context] { require_wanted(context); };
  return caller;
}

void Calls::require_wanted(const grpc::ServerContext& context) const {
  if (context.IsCancelled()) throw Cancelled();
  if (end_.stop_requested()) throw Stopping();
}

}  // namespace kcs::service
