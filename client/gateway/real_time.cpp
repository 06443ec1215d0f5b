#include "client/gateway/real_time.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

namespace kcs::gateway {
namespace {

// Above the kernel's interrupt threads (50), below its watchdogs (99).
constexpr int kPlayingPriority = 80;
constexpr int kFeedingPriority = 40;

bool schedule(int policy, int priority) {
  const sched_param parameters = {.sched_priority = priority};
  return pthread_setschedparam(pthread_self(), policy, &parameters) == 0;
}

}  // namespace

RealTime::RealTime() : fifo_(schedule(SCHED_FIFO, kPlayingPriority)), memory_locked_(mlockall(MCL_CURRENT) == 0) {}

RealTime::~RealTime() {
  if (memory_locked_) munlockall();
  if (fifo_) schedule(SCHED_OTHER, 0);
}

void feed_in_real_time() { schedule(SCHED_FIFO, kFeedingPriority); }

}  // namespace kcs::gateway
