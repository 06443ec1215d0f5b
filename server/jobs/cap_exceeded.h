// A request that is fine in itself, but too much for this server.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace kcs::jobs {

// Thrown when a request passes a cap of the server. what() names the cap, its value and the remedy.
class CapExceeded : public std::runtime_error {
 public:
  // `cap`: its name in the configuration file. `remedy`: a sentence without its full stop, such as "try again later".
  // `retry_after`: when that may help, if it may.
  CapExceeded(std::string_view cap, std::uint64_t value, std::string_view remedy,
              std::optional<std::chrono::milliseconds> retry_after = std::nullopt)
      : std::runtime_error("the server's cap " + std::string(cap) + " = " + std::to_string(value) +
                           " is reached: " + std::string(remedy)),
        cap_(cap),
        retry_after_(retry_after) {}

  const std::string& cap() const { return cap_; }
  std::optional<std::chrono::milliseconds> retry_after() const { return retry_after_; }

 private:
  std::string cap_;
  std::optional<std::chrono::milliseconds> retry_after_;
};

}  // namespace kcs::jobs
