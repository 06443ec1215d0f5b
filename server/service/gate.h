// Lets a bounded number of calls through at the same time.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string_view>

#include "server/jobs/cap_exceeded.h"

namespace kcs::service {

// A call that found no place may find one then: most are short.
inline constexpr std::chrono::seconds kGateRetry{1};

class Gate {
 public:
  // `cap`: its name in the configuration; a literal.
  Gate(std::string_view cap, std::uint64_t most) : cap_(cap), most_(most) {}

  // One call that went through, for as long as this lives.
  class Pass {
   public:
    // Throws jobs::CapExceeded if the gate is full.
    explicit Pass(Gate& gate) : gate_(gate) {
      if (++gate_.inside_ > gate_.most_) {
        --gate_.inside_;
        throw jobs::CapExceeded(gate_.cap_, gate_.most_, "try again later", kGateRetry);
      }
    }
    ~Pass() { --gate_.inside_; }
    Pass(const Pass&) = delete;
    Pass& operator=(const Pass&) = delete;

   private:
    Gate& gate_;
  };

 private:
  const std::string_view cap_;
  const std::uint64_t most_;
  std::atomic<std::uint64_t> inside_ = 0;
};

}  // namespace kcs::service
