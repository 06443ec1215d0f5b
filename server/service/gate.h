// Lets a bounded number of calls through at the same time.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <string_view>

#include "server/jobs/cap_exceeded.h"
#include "server/jobs/fair_queue.h"

namespace kcs::service {

// A call that found no place may find one then: most are short.
inline constexpr std::chrono::seconds kGateRetry{1};

// A number that may not be passed, and its name in the configuration, a literal.
struct GateCap {
  std::string_view name;
  std::uint64_t most;
};

// Safe for use by many threads at once.
class Gate {
 public:
  // all: calls inside; of_client: those of one client among them.
  Gate(const GateCap& all, const GateCap& of_client) : all_(all), of_client_(of_client) {}

  // One call that went through, for as long as this lives.
  class Pass {
   public:
    // Throws jobs::CapExceeded if the gate is full.
    Pass(Gate& gate, const jobs::Client& client) : gate_(gate), place_(gate.enter(client)) {}
    ~Pass() { gate_.leave(place_); }
    Pass(const Pass&) = delete;
    Pass& operator=(const Pass&) = delete;

   private:
    Gate& gate_;
    const std::map<jobs::Client, std::uint64_t>::iterator place_;
  };

 private:
  using Clients = std::map<jobs::Client, std::uint64_t>;

  Clients::iterator enter(const jobs::Client& client) {
    const std::lock_guard lock(mutex_);
    require(inside_ < all_.most, all_);
    const auto found = inside_of_.find(client);
    require((found == inside_of_.end() ? 0 : found->second) < of_client_.most, of_client_);
    const auto place = inside_of_.try_emplace(client, 0).first;
    ++place->second;
    ++inside_;
    return place;
  }

  void leave(Clients::iterator place) {
    const std::lock_guard lock(mutex_);
    --inside_;
    if (--place->second == 0) inside_of_.erase(place);
  }

  static void require(bool has_room, const GateCap& cap) {
    if (!has_room) throw jobs::CapExceeded(cap.name, cap.most, "try again later", kGateRetry);
  }

  const GateCap all_, of_client_;
  std::mutex mutex_;
  std::uint64_t inside_ = 0;
  Clients inside_of_;  // of those who have calls inside
};

}  // namespace kcs::service
