// How punctual a periodic thread is.
#pragma once

#include <cstdint>
#include <vector>

namespace kcs::gateway {

// A histogram of how late ticks began. Recording takes constant time and allocates nothing.
class Lateness {
 public:
  Lateness();

  // A tick began `nanoseconds` after it was due.
  void record(std::int64_t nanoseconds);

  // The lateness in µs that the given share of the ticks (0 to 1) did not exceed, rounded up to a whole µs; 0 without
  // ticks. Beyond 10 ms the histogram says no more than the maximum.
  double percentile_us(double share) const;

  double max_us() const;

 private:
  std::vector<std::uint64_t> ticks_of_microsecond_;
  std::uint64_t ticks_ = 0;
  std::int64_t max_ = 0;  // ns
};

}  // namespace kcs::gateway
