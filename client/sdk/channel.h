// The gRPC channel of a connection. Used inside the library, and by programs that speak a service which it does not.
#pragma once

#include <grpcpp/channel.h>

#include <chrono>
#include <memory>

#include "client/sdk/connection.h"

namespace kcs::client {

// How soon a channel finds out that its connection is dead, and makes a new one.
struct ChannelPace {
  // A server that was silent for so long is asked whether it lives, and taken for dead without an answer in time. One
  // that answers keeps a call alive, even one that plans for an hour.
  std::chrono::milliseconds ping_after_silence = std::chrono::seconds(10);
  std::chrono::milliseconds ping_timeout = std::chrono::seconds(10);
  // Between two attempts to connect: after the first one, at least 100 ms, and after many.
  std::chrono::milliseconds first_pause = std::chrono::seconds(1);
  std::chrono::milliseconds longest_pause = std::chrono::minutes(2);
};

// Does not connect yet. With connection.tries_again, calls that are safe to repeat are made up to 4 times. Throws
// std::system_error if a file cannot be read, Error ("INVALID_ARGUMENT") if the connection contradicts itself, or would
// show its token to whoever listens on the network.
std::shared_ptr<grpc::Channel> open_channel(const Connection& connection, const ChannelPace& pace = {});

}  // namespace kcs::client
