// When the setpoints of a stream are due.
#pragma once

#include <kcs/v1/planning.pb.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <stop_token>

namespace kcs::service {

// The real-time pace that a client asked for, counted from construction; without one, everything is due at once. Waits
// asleep. For one thread.
class Pace {
 public:
  // stop: the server ends its streams. is_cancelled: whether the client has ended this one. Throws
  // planning::InvalidInput if the lead cannot be served; the request's other numbers must have been checked.
  Pace(const v1::StreamSetpointsRequest& request, std::stop_token stop, std::function<bool()> is_cancelled);

  // Waits until a batch that begins with this setpoint is due. Throws Stopping as soon as the server ends its streams,
  // and Cancelled within 0.1 s after the client ended this one.
  void wait_for(std::uint64_t first_index);

 private:
  using Clock = std::chrono::steady_clock;

  double time_left(std::uint64_t first_index) const;

  std::stop_token stop_;
  std::function<bool()> is_cancelled_;
  bool has_lead_;
  double lead_, period_;  // s
  std::uint64_t start_index_;
  Clock::time_point start_ = Clock::now();
  std::mutex mutex_;
  std::condition_variable_any never_;  // comes; but stop_ ends waiting for it
};

}  // namespace kcs::service
