#include "client/sdk/server_link.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "client/sdk/channel.h"
#include "client/sdk/error.h"
#include "client/sdk/no_connection.h"
#include "client/sdk/status_error.h"
#include "kcs/v1/planning.grpc.pb.h"

namespace kcs::client {
namespace {

using Clock = std::chrono::system_clock;  // gRPC's deadlines go by it

constexpr std::chrono::milliseconds kLookForStop{50};  // while waiting for a connection
constexpr std::chrono::seconds kLookForReason{1};      // when there was none

}  // namespace

ServerLink::ServerLink(std::shared_ptr<grpc::Channel> channel, Connection server)
    : channel_(std::move(channel)), server_(std::move(server)) {}

void ServerLink::await_server(const std::stop_token& stop) const {
  if (server_.address.empty()) return;
  const auto deadline = Clock::now() + server_.patience;
  while (true) {
    const grpc_connectivity_state state = channel_->GetState(/*try_to_connect=*/true);
    if (state == GRPC_CHANNEL_READY) return;
    if (stop.stop_requested()) throw Error("CANCELLED", fmt::format("stopped while connecting to {}", server_.address));
    if (state == GRPC_CHANNEL_TRANSIENT_FAILURE && !changes_from(state)) {
      throw Error("UNAVAILABLE", explain_no_connection(server_, reason()));
    }
    if (Clock::now() >= deadline) throw Error("UNAVAILABLE", explain_no_connection(server_, "no answer"));
    channel_->WaitForStateChange(state, std::min(deadline, Clock::now() + kLookForStop));
  }
}

// A channel sees what has become of its attempts to connect while somebody waits for it, otherwise every 5 s: one that
// failed a while ago may have got through meanwhile.
bool ServerLink::changes_from(grpc_connectivity_state state) const {
  return channel_->WaitForStateChange(state, Clock::now() + kLookForStop);
}

void ServerLink::check(const grpc::Status& status) const {
  if (!status.ok()) throw_error(status, server_.address);
}

void ServerLink::set_deadline(grpc::ClientContext& context) const {
  if (!server_.address.empty()) context.set_deadline(Clock::now() + server_.patience);
}

// What gRPC says about a connection that failed. It does so to calls only, and at once to those that are not repeated.
std::string ServerLink::reason() const {
  Connection once = server_;
  once.tries_again = false;
  grpc::ClientContext context;
  context.set_deadline(Clock::now() + kLookForReason);
  v1::Plan plan;
  return v1::PlanningService::NewStub(open_channel(once))->GetPlan(&context, {}, &plan).error_message();
}

}  // namespace kcs::client
