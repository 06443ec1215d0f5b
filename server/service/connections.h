// How long connections live.
#pragma once

#include <chrono>

namespace grpc {
class ServerBuilder;
}

namespace kcs::service {

struct ConnectionSettings {
  // A connection on which nothing came for so long is asked whether it still lives, and closed if no answer comes: a
  // client that vanished without a word does not hold its stream for ever.
  std::chrono::milliseconds keepalive = std::chrono::seconds(30);
  std::chrono::milliseconds keepalive_timeout = std::chrono::seconds(10);
  // A client may ask the same no more often than this.
  std::chrono::milliseconds shortest_ping_interval = std::chrono::seconds(5);
  // By then a client must have said hello, TLS included.
  std::chrono::milliseconds handshake = std::chrono::seconds(20);
  // At this age, give or take a tenth, a client is told to open a new connection for its next call, so that it meets
  // the certificate of the day and a balancer can send it elsewhere; 0: at no age. The calls that run go on, but no
  // longer than the grace; 0: as long as they take.
  std::chrono::milliseconds longest_age = std::chrono::hours(1);
  std::chrono::milliseconds age_grace = std::chrono::milliseconds(0);
};

void apply(const ConnectionSettings& settings, grpc::ServerBuilder& builder);

}  // namespace kcs::service
