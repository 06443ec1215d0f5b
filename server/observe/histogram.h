// How durations are distributed: how many of them are at most so long.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <string_view>

#include "server/observe/exposition.h"

namespace kcs::observe {

// Upper bounds of the buckets, s: from half a millisecond to an hour, some three a decade.
inline constexpr std::array<double, 20> kDurationBounds = {
    0.0005, 0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1, 2.5, 5, 10, 30, 60, 300, 600, 1800, 3600};

// Safe for use by many threads at once; observe() costs two atomic additions. What is shown while others observe may
// miss the latest durations in its sum, but its buckets always add up to its count.
class Histogram {
 public:
  static constexpr std::string_view kType = "histogram";

  void observe(std::chrono::duration<double> time);

  std::uint64_t count() const;

  void expose(SampleWriter writer) const;

  // Observes its own lifetime.
  class Stopwatch {
   public:
    explicit Stopwatch(Histogram& histogram) : histogram_(histogram) {}
    ~Stopwatch() { histogram_.observe(std::chrono::steady_clock::now() - began_); }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

   private:
    Histogram& histogram_;
    const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  };

 private:
  // Durations in each bucket alone; in the last one those beyond the bounds.
  std::array<std::atomic<std::uint64_t>, kDurationBounds.size() + 1> counts_{};
  std::atomic<double> sum_ = 0;  // s
};

}  // namespace kcs::observe
