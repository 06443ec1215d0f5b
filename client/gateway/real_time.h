// Puts a thread before all ordinary ones.
#pragma once

namespace kcs::gateway {

// Asks that the calling thread run in real time (SCHED_FIFO) and that its memory stay in RAM, for as long as this
// object lives. The system grants that to root, or to a program with the capabilities CAP_SYS_NICE and CAP_IPC_LOCK;
// without them the thread goes on as an ordinary one, and fifo() and memory_locked() say so.
//
// Locks what memory there is when it is made: make it when everything that the thread touches exists. Memory that other
// threads allocate later stays unlocked; they may wait.
class RealTime {
 public:
  RealTime();
  ~RealTime();
  RealTime(const RealTime&) = delete;
  RealTime& operator=(const RealTime&) = delete;

  bool fifo() const { return fifo_; }
  bool memory_locked() const { return memory_locked_; }

 private:
  bool fifo_;
  bool memory_locked_;
};

// The same for a thread that brings motion to the one that plays: before all ordinary ones, after the one that plays
// and the kernel's interrupts. Threads that it begins are like it. Without the right to it, it stays as it is.
void feed_in_real_time();

}  // namespace kcs::gateway
