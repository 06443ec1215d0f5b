// What is half done is cleared away when a signal ends the process.
#pragma once

#include <signal.h>

#include <functional>
#include <thread>

namespace kcs::cli {

// From construction to destruction, Ctrl-C (SIGINT), SIGTERM and SIGHUP call `clean_up` and then end the process, as
// they do without it. Signals that the process ignores stay ignored. `clean_up` runs on a thread of its own, which does
// nothing but wait for these signals, so it is free to do anything; it must not throw.
// Make it before the threads whose work it guards: a thread that runs already would take the signal itself.
class CleanUpOnSignal {
 public:
  explicit CleanUpOnSignal(std::function<void()> clean_up);
  ~CleanUpOnSignal();
  CleanUpOnSignal(const CleanUpOnSignal&) = delete;
  CleanUpOnSignal& operator=(const CleanUpOnSignal&) = delete;

 private:
  void watch(const std::stop_token& stop) const;

  std::function<void()> clean_up_;
  sigset_t signals_{};
  sigset_t blocked_before_{};
  std::jthread thread_;  // last: it uses all the others
};

}  // namespace kcs::cli
