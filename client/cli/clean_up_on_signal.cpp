#include "client/cli/clean_up_on_signal.h"

#include <utility>

namespace kcs::cli {
namespace {

bool is_ignored(int signal) {
  struct sigaction action {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

CleanUpOnSignal::CleanUpOnSignal(std::function<void()> clean_up) : clean_up_(std::move(clean_up)) {
  sigemptyset(&signals_);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals_, signal);
  pthread_sigmask(SIG_BLOCK, &signals_, &blocked_before_);  // in the threads started from here on, too
  thread_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
}

CleanUpOnSignal::~CleanUpOnSignal() {
  thread_.request_stop();
  pthread_kill(thread_.native_handle(), SIGHUP);  // for this thread alone: it wakes up and sees the stop
  thread_.join();
  pthread_sigmask(SIG_SETMASK, &blocked_before_, nullptr);
}

void CleanUpOnSignal::watch(const std::stop_token& stop) const {
  for (int signal = 0; sigwait(&signals_, &signal) == 0 && !stop.stop_requested();) {
    if (is_ignored(signal)) continue;
    clean_up_();
    pthread_sigmask(SIG_UNBLOCK, &signals_, nullptr);
    raise(signal);
  }
}

}  // namespace kcs::cli
