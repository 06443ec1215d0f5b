// The threads that plan.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace kcs::jobs {

// A fixed number of threads that run tasks in the order in which they came, behind a queue of bounded length.
class WorkerPool {
 public:
  // threads ≥ 1. `queue_length`: tasks that may wait; a task that a free thread takes up does not wait.
  WorkerPool(std::size_t threads, std::size_t queue_length);
  // Finishes the tasks that run and drops those that wait.
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  // Has `task` run soon; it must not throw. Throws CapExceeded if the queue is full.
  void submit(std::function<void()> task);

  struct Load {
    std::size_t waiting;  // tasks that no thread has taken up
    std::size_t running;
  };
  Load load() const;

 private:
  void work();

  std::size_t queue_length_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> waiting_;
  std::size_t idle_ = 0;  // threads without a task
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace kcs::jobs
