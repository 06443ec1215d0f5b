#include "server/jobs/worker_pool.h"

#include <utility>

#include "server/jobs/cap_exceeded.h"

namespace kcs::jobs {
namespace {

// When a full queue may have a place again: most plans take less.
constexpr std::chrono::seconds kQueueRetry{1};

}  // namespace

WorkerPool::WorkerPool(std::size_t threads, std::size_t queue_length) : queue_length_(queue_length), idle_(threads) {
  threads_.reserve(threads);
  for (std::size_t i = 0; i < threads; ++i) threads_.emplace_back([this] { work(); });
}

WorkerPool::~WorkerPool() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void WorkerPool::submit(std::function<void()> task) {
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() >= queue_length_ + idle_) {
      throw CapExceeded("queue_length", queue_length_, "try again later", kQueueRetry);
    }
    waiting_.push_back(std::move(task));
  }
  changed_.notify_one();
}

WorkerPool::Load WorkerPool::load() const {
  const std::lock_guard lock(mutex_);
  return {waiting_.size(), threads_.size() - idle_};
}

void WorkerPool::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stopping_ || !waiting_.empty(); });
    if (stopping_) return;
    {
      const std::function<void()> task = std::move(waiting_.front());
      waiting_.pop_front();
      --idle_;
      lock.unlock();
      task();
    }
    lock.lock();
    ++idle_;
  }
}

}  // namespace kcs::jobs
