#include "server/service/peer.h"

#include <string_view>

#include "server/http/plan_pages.h"

namespace kcs::service {
namespace {

constexpr std::string_view kInProcess = "unknown";  // to gRPC; whoever comes by a socket has an address

}  // namespace

std::string peer_of(const grpc::ServerContext& context) {
  std::string peer = context.peer();
  if (peer != kInProcess) return peer;  // others say of themselves what they like
  const auto told = context.client_metadata().find(http::kPeerKey);
  return told == context.client_metadata().end() ? peer : std::string(told->second.data(), told->second.size());
}

}  // namespace kcs::service
