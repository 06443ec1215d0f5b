#include "server/store/call_watch.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <iterator>

namespace kcs::store {

CallWatch::CallWatch(std::chrono::milliseconds patience)
    : patience_(patience), thread_([this](const std::stop_token& stopping) { work(stopping); }) {}

CallWatch::Call::Call(CallWatch& watch, int socket)
    : watch_(watch), socket_(socket < 0 ? -1 : fcntl(socket, F_DUPFD_CLOEXEC, 0)) {
  if (socket_ < 0) return;
  const std::lock_guard lock(watch_.mutex_);
  watch_.calls_.push_back({std::chrono::steady_clock::now() + watch_.patience_, socket_});
  entry_ = std::prev(watch_.calls_.end());
}

CallWatch::Call::~Call() {
  if (socket_ < 0) return;
  {
    const std::lock_guard lock(watch_.mutex_);
    watch_.calls_.erase(entry_);
  }
  close(socket_);
}

void CallWatch::work(const std::stop_token& stopping) {
  std::unique_lock lock(mutex_);
  while (!stopping.stop_requested()) {
    const auto now = std::chrono::steady_clock::now();
    auto next = now + patience_;  // no call that comes later has an earlier deadline
    for (const Entry& call : calls_) {
      if (call.deadline > now) {
        next = call.deadline;
        break;
      }
      shutdown(call.socket, SHUT_RDWR);
    }
    stopped_.wait_until(lock, stopping, next, [] { return false; });
  }
}

}  // namespace kcs::store
