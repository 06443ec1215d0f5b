// Ends calls that wait for a database that is gone without a word.
#pragma once

#include <chrono>
#include <condition_variable>
#include <list>
#include <mutex>
#include <stop_token>
#include <thread>

namespace kcs::store {

// Cuts the connection of a call that takes too long: whoever waits for the other side's answer learns at once that none
// comes. The network itself would notice a dead host after many minutes, a frozen one never.
class CallWatch {
  struct Entry {
    std::chrono::steady_clock::time_point deadline;
    int socket;
  };

 public:
  // `patience`: how long a call may take.
  explicit CallWatch(std::chrono::milliseconds patience);
  CallWatch(const CallWatch&) = delete;
  CallWatch& operator=(const CallWatch&) = delete;

  // A call under way, from construction to destruction. The watch outlives it.
  class Call {
   public:
    // `socket`: of the connection; −1 if it has none, then nothing is watched.
    Call(CallWatch& watch, int socket);
    ~Call();
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;

   private:
    CallWatch& watch_;
    int socket_;  // a duplicate: the library may close its own, and the number may be given to somebody else then
    std::list<Entry>::iterator entry_;
  };

 private:
  void work(const std::stop_token& stopping);

  const std::chrono::milliseconds patience_;
  std::mutex mutex_;
  std::condition_variable_any stopped_;
  std::list<Entry> calls_;  // the earliest deadline first
  std::jthread thread_;     // last, so that it is gone before what it uses
};

}  // namespace kcs::store
