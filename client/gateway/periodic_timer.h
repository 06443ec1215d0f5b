// Wakes a thread at a fixed period on the monotonic clock.
#pragma once

#include <cstdint>

namespace kcs::gateway {

// The monotonic clock, s.
double monotonic_s();

// Every deadline is a fixed instant, start + i × period and what it was shifted by, so that one late tick does not make
// the next one late and the period does not drift. If whole periods pass without a tick, because the computer did not
// run the thread, all later deadlines are that much later: to catch up would be to send many setpoints at once, which
// is a jump for drives that take one each period.
class PeriodicTimer {
 public:
  // period_s > 0. The first deadline is one period from now.
  explicit PeriodicTimer(double period_s);

  // Sleeps until the next deadline; at once if that has passed. Returns how late the thread woke, ns.
  std::int64_t wait();

  // Moves all later deadlines, by less than a period.
  void shift(double nanoseconds) { shifted_ += nanoseconds; }

  // From the beginning to the last deadline, without what was missed, ns.
  double elapsed_ns() const { return static_cast<double>(ticks_) * period_ + shifted_; }

  // Whole periods that passed without a tick, so far.
  std::uint64_t missed() const { return missed_; }

 private:
  double period_;            // ns
  std::int64_t start_;       // ns on the monotonic clock; later by what was missed
  std::uint64_t ticks_ = 0;  // deadlines so far
  double shifted_ = 0;       // ns, in all
  std::uint64_t missed_ = 0;
};

}  // namespace kcs::gateway
