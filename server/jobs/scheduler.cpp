#include "server/jobs/scheduler.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "server/jobs/cap_exceeded.h"

namespace kcs::jobs {
namespace {

// Long enough that most jobs are done in one, short enough for somebody who looks at a screen.
constexpr FairQueue::Time kTurn{0.1};
// What a job takes as long as none was done.
constexpr FairQueue::Time kFirstGuess{1};
// How much the latest job says of the next ones.
constexpr double kNews = 0.2;
// What a client may be told to wait for.
constexpr std::chrono::milliseconds kShortestWait{100}, kLongestWait{60'000};

}  // namespace

Scheduler::Scheduler(const Limits& limits, Clock clock)
    : limits_(limits),
      clock_(std::move(clock)),
      queue_(limits.client_running, kTurn),
      idle_(limits.threads),
      time_per_job_(kFirstGuess) {
  threads_.reserve(limits.threads);
  for (std::size_t i = 0; i < limits.threads; ++i) threads_.emplace_back([this] { work(); });
}

Scheduler::~Scheduler() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    for (const auto& [id, job] : jobs_) job->stop.request_stop();
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

JobId Scheduler::submit(const Client& client, Priority priority, Step step) {
  auto job = std::make_shared<Job>();
  job->step = std::move(step);
  const std::lock_guard lock(mutex_);
  if (const std::size_t waiting = queue_.waiting(); waiting >= limits_.queue_length + idle_) {
    throw CapExceeded("queue_length", limits_.queue_length, "try again later", time_of(waiting));
  }
  check_client(client);
  const JobId id = next_job_++;
  jobs_.emplace(id, std::move(job));
  queue_.add(id, client, priority);
  changed_.notify_one();
  return id;
}

void Scheduler::join(JobId id, const Client& client, Priority priority) {
  const std::lock_guard lock(mutex_);
  if (!jobs_.contains(id)) return;
  if (!queue_.wanted_by(client, id)) check_client(client);
  queue_.add(id, client, priority);
  changed_.notify_one();  // the job's other clients may have no thread left
}

void Scheduler::check_client(const Client& client) const {
  const std::size_t waiting = queue_.waiting(client);
  const std::size_t free = std::min(idle_, limits_.client_running - queue_.running(client));
  if (waiting < limits_.client_waiting + free) return;
  throw CapExceeded("client_waiting", limits_.client_waiting, "wait for what you have asked for already",
                    time_of(waiting * queue_.clients_waiting()));
}

// Until so many jobs that wait are done, if they are like the last ones.
std::chrono::milliseconds Scheduler::time_of(std::size_t jobs) const {
  const auto time = time_per_job_ * static_cast<double>(jobs) / static_cast<double>(limits_.threads);
  return std::clamp(std::chrono::duration_cast<std::chrono::milliseconds>(time), kShortestWait, kLongestWait);
}

void Scheduler::leave(JobId id, const Client& client) {
  std::shared_ptr<Job> job;  // dies after the lock is gone: it may be large
  const std::lock_guard lock(mutex_);
  if (!queue_.leave(id, client)) job = forget(id);
}

std::shared_ptr<Scheduler::Job> Scheduler::forget(JobId id) {
  const auto found = jobs_.find(id);
  if (found == jobs_.end()) return nullptr;
  std::shared_ptr<Job> job = std::move(found->second);
  jobs_.erase(found);
  job->stop.request_stop();
  return job;
}

std::size_t Scheduler::ahead(JobId id) const {
  const std::lock_guard lock(mutex_);
  return queue_.ahead(id);
}

Scheduler::Load Scheduler::load() const {
  const std::lock_guard lock(mutex_);
  return {queue_.waiting(), limits_.threads - idle_};
}

void Scheduler::work() {
  while (true) {
    std::optional<FairQueue::Turn> turn;
    std::shared_ptr<Job> job;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return stopping_ || (turn = queue_.take()).has_value(); });
      if (stopping_) return;
      job = jobs_.at(turn->job);
      --idle_;
    }
    run(*turn, *job);
  }
}

void Scheduler::run(const FairQueue::Turn& turn, Job& job) {
  const auto began = clock_();
  bool more = true;
  FairQueue::Time used{0};
  while (more && used < kTurn) {
    more = job.step(job.stop.get_token());
    used = clock_() - began;
  }
  const std::lock_guard lock(mutex_);
  ++idle_;
  job.used += used;
  queue_.give_back(turn, used);
  if (!more) {
    queue_.remove(turn.job);
    if (jobs_.erase(turn.job) > 0) time_per_job_ += kNews * (job.used - time_per_job_);
  }
  // The client may have a turn left again, and this thread may take up another client's job.
  changed_.notify_one();
}

}  // namespace kcs::jobs
