#include "server/service/connection_settings.h"

namespace kcs::service {

Keys connection_keys(ConnectionSettings& settings) {
  constexpr double kShortest = 0.1;
  constexpr double kLongest = 1'000'000;  // gRPC counts milliseconds in an int
  return {{"keepalive_s", seconds(settings.keepalive, kShortest, kLongest)},
          {"keepalive_timeout_s", seconds(settings.keepalive_timeout, kShortest, kLongest)},
          {"shortest_ping_interval_s", seconds(settings.shortest_ping_interval, 0, kLongest)},
          {"handshake_s", seconds(settings.handshake, kShortest, kLongest)},
          {"longest_age_s", seconds(settings.longest_age, 0, kLongest)},
          {"age_grace_s", seconds(settings.age_grace, 0, kLongest)}};
}

}  // namespace kcs::service
