#include "client/gateway/periodic_timer.h"

#include <algorithm>
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

PeriodicTimer::PeriodicTimer(double period_s) : period_(period_s * static_cast<double>(kNanoseconds)), start_(now()) {}

std::int64_t PeriodicTimer::wait() {
  ++ticks_;
  const std::int64_t deadline = start_ + std::llround(elapsed_ns());
  const timespec wake_at = {.tv_sec = deadline / kNanoseconds, .tv_nsec = deadline % kNanoseconds};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wake_at, nullptr) == EINTR) {
  }
  const std::int64_t late = now() - deadline;
  const double missed = std::max(0.0, std::floor(static_cast<double>(late) / period_));
  missed_ += static_cast<std::uint64_t>(missed);
  start_ += std::llround(missed * period_);
  return late;
}

}  // namespace kcs::gateway
