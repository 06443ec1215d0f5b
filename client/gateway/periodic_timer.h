// Wakes a thread at a fixed period on the monotonic clock.
#pragma once

#include <cstdint>

namespace kcs::gateway {

// The monotonic clock, s.
double monotonic_s();

// Every deadline is a fixed instant, start + i × period and what it was shifted by, so that one late tick does not make
// the next one late and the period does not drift. Nothing is skipped: a thread that is behind catches up tick by tick.
class PeriodicTimer {
 public:
  // period_s > 0. The first deadline is one period from now.
  explicit PeriodicTimer(double period_s);

  // Sleeps until the next deadline; at once if that has passed. Returns how late the thread woke, ns.
  std::int64_t wait();

  // Moves all later deadlines, by less than a period.
  void shift(double nanoseconds) { shifted_ += nanoseconds; }

  // From the beginning to the last deadline, ns.
  double elapsed_ns() const { return static_cast<double>(deadline_ - start_); }

 private:
  double period_;            // ns
  std::int64_t start_;       // ns on the monotonic clock
  std::uint64_t ticks_ = 0;  // deadlines so far
  double shifted_ = 0;       // ns, in all
  std::int64_t deadline_;    // the last one
};

}  // namespace kcs::gateway
