// How the calls ended.
#pragma once

#include <grpcpp/support/status.h>

#include <chrono>
#include <functional>
#include <initializer_list>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace kcs::soak {

using Clock = std::chrono::steady_clock;

// Safe for use by many threads at once.
class Tally {
 public:
  // outage: whether there was no server at some time since then, so that UNAVAILABLE is no surprise.
  explicit Tally(std::function<bool(Clock::time_point since)> outage) : outage_(std::move(outage)) {}

  // Counts a call that began then; a fault if it ended neither OK nor as expected. Returns whether it ended OK.
  bool count(const std::string& method, Clock::time_point began, const grpc::Status& status,
             std::initializer_list<grpc::StatusCode> expected);

  // What must not happen.
  void fault(const std::string& what);

  // A small plan that was asked for then is there; counts how long it took, if there was a server all the time.
  void small_plan(Clock::time_point began);

  int faults() const;
  // Calls by method and result, latencies, the first faults: lines for people.
  std::string text() const;

 private:
  const std::function<bool(Clock::time_point)> outage_;
  mutable std::mutex mutex_;
  std::map<std::pair<std::string, std::string>, int> calls_;  // by method and result
  std::vector<double> small_plans_;                           // ms
  std::vector<std::string> first_faults_;
  int faults_ = 0;
};

}  // namespace kcs::soak
