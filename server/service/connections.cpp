#include "server/service/connections.h"

#include <grpcpp/server_builder.h>

#include <string>

namespace kcs::service {

void apply(const ConnectionSettings& settings, grpc::ServerBuilder& builder) {
  const auto set = [&builder](const std::string& argument, std::chrono::milliseconds value) {
    builder.AddChannelArgument(argument, static_cast<int>(value.count()));
  };
  set(GRPC_ARG_KEEPALIVE_TIME_MS, settings.keepalive);
  set(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, settings.keepalive_timeout);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  set(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS, settings.shortest_ping_interval);
  set(GRPC_ARG_SERVER_HANDSHAKE_TIMEOUT_MS, settings.handshake);
  if (settings.longest_age.count() > 0) set(GRPC_ARG_MAX_CONNECTION_AGE_MS, settings.longest_age);
  if (settings.age_grace.count() > 0) set(GRPC_ARG_MAX_CONNECTION_AGE_GRACE_MS, settings.age_grace);
}

}  // namespace kcs::service
