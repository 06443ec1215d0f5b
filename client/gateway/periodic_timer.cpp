#include "client/gateway/periodic_timer.h"

#include <cerrno>
#include <cmath>
#include <ctime>

namespace kcs::gateway {
namespace {

constexpr std::int64_t kNanoseconds = 1'000'000'000;  // in a second

std::int64_t now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * kNanoseconds + time.tv_nsec;
}

}  // namespace

double monotonic_s() { return static_cast<double>(now()) / static_cast<double>(kNanoseconds); }

PeriodicTimer::PeriodicTimer(double period_s)
    : period_(period_s * static_cast<double>(kNanoseconds)), start_(now()), deadline_(start_) {}

std::int64_t PeriodicTimer::wait() {
  ++ticks_;
  deadline_ = start_ + std::llround(static_cast<double>(ticks_) * period_ + shifted_);
  const timespec wake_at = {.tv_sec = deadline_ / kNanoseconds, .tv_nsec = deadline_ % kNanoseconds};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wake_at, nullptr) == EINTR) {
  }
  return now() - deadline_;
}

}  // namespace kcs::gateway
