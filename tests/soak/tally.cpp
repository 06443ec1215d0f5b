#include "tests/soak/tally.h"

#include <absl/status/status.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace kcs::soak {
namespace {

constexpr std::size_t kFaultsShown = 10;

double percentile(const std::vector<double>& sorted, double share) {
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

}  // namespace

bool Tally::count(const std::string& method, Clock::time_point began, const grpc::Status& status,
                  std::initializer_list<grpc::StatusCode> expected) {
  const grpc::StatusCode code = status.error_code();
  const std::string result = absl::StatusCodeToString(static_cast<absl::StatusCode>(code));  // the same numbers
  const bool fine = status.ok() || std::find(expected.begin(), expected.end(), code) != expected.end() ||
                    (code == grpc::StatusCode::UNAVAILABLE && outage_(began));
  {
    const std::lock_guard lock(mutex_);
    ++calls_[{method, result}];
  }
  if (!fine) fault(fmt::format("{} was answered {}: {}", method, result, status.error_message()));
  return status.ok();
}

void Tally::fault(const std::string& what) {
  const std::lock_guard lock(mutex_);
  ++faults_;
  if (first_faults_.size() < kFaultsShown) first_faults_.push_back(what);
}

void Tally::small_plan(Clock::time_point began) {
  const std::chrono::duration<double, std::milli> taken = Clock::now() - began;
  if (outage_(began)) return;
  const std::lock_guard lock(mutex_);
  small_plans_.push_back(taken.count());
}

int Tally::faults() const {
  const std::lock_guard lock(mutex_);
  return faults_;
}

std::string Tally::text() const {
  const std::lock_guard lock(mutex_);
  std::string text = fmt::format("{:<20}{:<22}{:>10}\n", "Method", "Result", "Calls");
  const auto out = std::back_inserter(text);
  for (const auto& [call, count] : calls_) fmt::format_to(out, "{:<20}{:<22}{:>10}\n", call.first, call.second, count);
  if (!small_plans_.empty()) {
    std::vector<double> sorted = small_plans_;
    std::sort(sorted.begin(), sorted.end());
    fmt::format_to(out, "\nSmall plans took p50 {:.1f} ms, p99 {:.1f} ms, at most {:.1f} ms\n", percentile(sorted, 0.5),
                   percentile(sorted, 0.99), sorted.back());
  }
  for (const std::string& fault : first_faults_) fmt::format_to(out, "FAULT: {}\n", fault);
  return text;
}

}  // namespace kcs::soak
