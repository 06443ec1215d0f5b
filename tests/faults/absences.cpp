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
  sched_param priority{};
  priority.sched_priority = sched_get_priority_max(SCHED_FIFO);
  if (pthread_setaffinity_np(thread, sizeof alone, &alone) != 0 ||
      pthread_setschedparam(thread, SCHED_FIFO, &priority) != 0) {
    throw std::runtime_error("threads may have no real-time priority here: run it as root, or allow RLIMIT_RTPRIO");
  }
}

}  // namespace

AbsenceWatch::AbsenceWatch() {
  for (unsigned processor = 0; processor < std::thread::hardware_concurrency(); ++processor) {
    pin_to(watchers_
               .emplace_back([this](const std::stop_token& stop) {
                 using Clock = std::chrono::steady_clock;
                 for (auto due = Clock::now(); !stop.stop_requested();) {
                   due += kLook;
                   std::this_thread::sleep_until(due);
                   const auto late = std::chrono::duration_cast<milliseconds>(Clock::now() - due);
                   if (late < kShortest) continue;
                   due = Clock::now();
                   const std::lock_guard lock(mutex_);
                   absences_.push_back({std::chrono::system_clock::now(), late});
                 }
               })
               .native_handle(),
           processor);
  }
}

std::vector<Absence> AbsenceWatch::absences() const {
  const std::lock_guard lock(mutex_);
  return absences_;
}

}  // namespace kcs::faults
