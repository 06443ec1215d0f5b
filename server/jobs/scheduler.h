// The threads that plan, and who gets them.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <thread>
#include <unordered_map>
#include <vector>

#include "server/jobs/fair_queue.h"

namespace kcs::jobs {

// A fixed number of threads that work on the jobs of many clients, in turns of a tenth of a second (fair_queue.h says
// whose): neither a thousand jobs of one client nor a very long one keep another client waiting for long. Safe for use
// by many threads at once.
class Scheduler {
 public:
  struct Limits {
    std::size_t threads;         // ≥ 1
    std::size_t queue_length;    // jobs that may wait; one that a free thread takes up does not wait
    std::size_t client_waiting;  // of one client, likewise
    std::size_t client_running;  // threads that work for one client at the same time, ≥ 1
  };

  // Does a bit of a job; true if there is more to do. A turn ends only between two steps, so steps should be short.
  // They are called by one thread at a time, not always the same, and must not throw. Once asked to stop, a step should
  // return soon; what it returns then does not matter.
  using Step = std::function<bool(const std::stop_token& stop)>;
  using Clock = std::function<std::chrono::steady_clock::time_point()>;

  // clock: what turns are measured with.
  explicit Scheduler(const Limits& limits, Clock clock = &std::chrono::steady_clock::now);
  // Drops the jobs that wait, asks those that run to stop, and waits until they have.
  ~Scheduler();
  Scheduler(const Scheduler&) = delete;
  Scheduler& operator=(const Scheduler&) = delete;

  // Has a job done. Throws CapExceeded, with the time after which trying again is worth it, if too many wait.
  JobId submit(const Client& client, Priority priority, Step step);
  // Has a job that is not done yet done for one more client, or with a higher priority for the same one. Throws
  // CapExceeded if too many of that client wait.
  void join(JobId job, const Client& client, Priority priority);
  // The client does not want it any more. If nobody does, a job that waits is dropped at once, together with its step;
  // one that runs is asked to stop.
  void leave(JobId job, const Client& client);

  // How many jobs have their first turn before the next one of this job, more or less; 0 if it does not wait.
  std::size_t ahead(JobId job) const;

  struct Load {
    std::size_t waiting = 0;  // jobs, for their first turn or the next
    std::size_t running = 0;  // jobs
  };
  // All of one moment.
  Load load() const;

 private:
  struct Job {
    Step step;
    std::stop_source stop;
    FairQueue::Time used{0};
  };

  void check_client(const Client& client) const;
  std::chrono::milliseconds time_of(std::size_t jobs) const;
  std::shared_ptr<Job> forget(JobId job);
  void work();
  void run(const FairQueue::Turn& turn, Job& job);

  const Limits limits_;
  const Clock clock_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  FairQueue queue_;
  std::unordered_map<JobId, std::shared_ptr<Job>> jobs_;  // that are not done
  JobId next_job_ = 0;
  std::size_t idle_;              // threads without a job
  FairQueue::Time time_per_job_;  // of those that were done lately
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace kcs::jobs
