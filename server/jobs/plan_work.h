// A request on its way to a plan.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <memory>
#include <mutex>
#include <stop_token>

#include "server/jobs/plan_request.h"
#include "server/planning/planner.h"

namespace kcs::jobs {

// How far a request has come.
struct Progress {
  enum class State { kWaiting, kPlanning, kDone, kFailed };

  State state = State::kWaiting;
  std::size_t requests_ahead = 0;  // that are planned before it, more or less; 0 once its turn has come
  std::size_t segment_count = 0;
  std::size_t segments_planned = 0;  // and verified; never less than before

  bool over() const { return state == State::kDone || state == State::kFailed; }
  bool operator==(const Progress&) const = default;
};

// The planning of one request, for all who wait for it. One thread at a time plans; what the others call is safe at any
// time.
class PlanWork {
 public:
  explicit PlanWork(PlanRequest request);
  // It is done already.
  explicit PlanWork(PlanPointer kept);

  // Plans a bit; true if there is more to do. Throws what planning::plan() throws.
  bool go_on(const std::stop_token& stop);
  // What was planned, once there is nothing more to do.
  const PlanPointer& made() const { return made_; }
  // That planning it took so far, without what it waited.
  std::chrono::duration<double> time() const { return time_; }

  // The end, for all who wait; the first of these calls counts.
  void succeed();
  void fail(std::exception_ptr reason);

  // Its path is gone once it is planned.
  const PlanRequest& request() const { return request_; }
  // requests_ahead is left at 0.
  Progress progress() const;
  // Waits until the state is another one than this, at the most so long.
  void wait_for_other(Progress::State state, std::chrono::milliseconds timeout) const;
  // Once it is over: the plan, or throws what it failed with.
  PlanPointer result() const;

 private:
  void begin(const std::stop_token& stop);
  void complete();
  void end(Progress::State state, std::exception_ptr reason);

  PlanRequest request_;
  const std::size_t segment_count_;
  PlanPointer made_;
  std::chrono::duration<double> time_{0};
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  Progress::State state_;
  std::exception_ptr failure_;
  std::unique_ptr<planning::Planner> planner_;  // from begin() to complete(); the planning thread alone changes it
};

}  // namespace kcs::jobs
