#include "tests/faults/absences.h"

#include <pthread.h>
#include <sched.h>

#include <stdexcept>
#include <stop_token>

namespace kcs::faults {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kLook{2}, kShortest{20};

void pin_to(pthread_t thread, unsigned processor) {
  cpu_set_t alone;
  CPU_ZERO(&alone);
  CPU_SET(processor, &alone);
  if (pthread_setaffinity_np(thread, sizeof alone, &alone) != 0) {
    throw std::runtime_error("a thread cannot be kept on one processor here");
  }
}

void go_before_all(pthread_t thread) {
  sched_param priority{};
  priority.sched_priority = sched_get_priority_max(SCHED_FIFO);
  if (pthread_setschedparam(thread, SCHED_FIFO, &priority) != 0) {
    throw std::runtime_error("threads may have no real-time priority here: run it as root, or allow RLIMIT_RTPRIO");
  }
}

}  // namespace

AbsenceWatch::AbsenceWatch() {
  for (unsigned processor = 0; processor < std::thread::hardware_concurrency(); ++processor) {
    for (const bool computer : {true, false}) {
      std::jthread& watcher =
          watchers_.emplace_back([this, computer](const std::stop_token& stop) { watch(stop, computer); });
      pin_to(watcher.native_handle(), processor);
      if (computer) go_before_all(watcher.native_handle());
    }
  }
}

void AbsenceWatch::watch(const std::stop_token& stop, bool computer) {
  using Clock = std::chrono::steady_clock;
  for (auto due = Clock::now(); !stop.stop_requested();) {
    due += kLook;
    std::this_thread::sleep_until(due);
    const auto late = std::chrono::duration_cast<milliseconds>(Clock::now() - due);
    if (late < kShortest) continue;
    due = Clock::now();
    const std::lock_guard lock(mutex_);
    absences_.push_back({computer, std::chrono::system_clock::now(), late});
  }
}

std::vector<Absence> AbsenceWatch::absences() const {
  const std::lock_guard lock(mutex_);
  return absences_;
}

}  // namespace kcs::faults
