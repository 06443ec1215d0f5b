#include "server/service/cancel_watch.h"

#include <chrono>

namespace kcs::service {
namespace {

constexpr std::chrono::milliseconds kLook{10};

}  // namespace

CancelWatch::CancelWatch() : thread_([this](const std::stop_token& stopping) { work(stopping); }) {}

CancelWatch::Call::Call(CancelWatch& watch, const grpc::ServerContext& context) : watch_(watch), context_(context) {
  {
    const std::lock_guard lock(watch_.mutex_);
    watch_.calls_.insert(this);
  }
  watch_.changed_.notify_one();
}

CancelWatch::Call::~Call() {
  const std::lock_guard lock(watch_.mutex_);
  watch_.calls_.erase(this);
}

void CancelWatch::work(const std::stop_token& stopping) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stopping, [this] { return !calls_.empty(); })) {
    for (Call* call : calls_) {
      if (call->context_.IsCancelled()) call->stop_.request_stop();
    }
    changed_.wait_for(lock, stopping, kLook, [] { return false; });
    if (stopping.stop_requested()) return;
  }
}

}  // namespace kcs::service
