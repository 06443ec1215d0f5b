#include "server/jobs/plan_work.h"

#include <utility>

namespace kcs::jobs {

using State = Progress::State;

PlanWork::PlanWork(PlanRequest request)
    : request_(std::move(request)), segment_count_(request_.path.segments.size()), state_(State::kWaiting) {}

PlanWork::PlanWork(PlanPointer kept)
    : segment_count_(kept->plan.summary.segments), made_(std::move(kept)), state_(State::kDone) {}

bool PlanWork::go_on(const std::stop_token& stop) {
  const auto began = std::chrono::steady_clock::now();
  if (!planner_) begin(stop);
  const bool more = planner_->go_on();
  time_ += std::chrono::steady_clock::now() - began;
  if (!more) complete();
  return more;
}

void PlanWork::begin(const std::stop_token& stop) {
  {
    const std::lock_guard lock(mutex_);
    if (state_ == State::kWaiting) state_ = State::kPlanning;
  }
  changed_.notify_all();
  planning::PlanOptions options = request_.options.planning;
  options.stop = stop;
  auto planner = std::make_unique<planning::Planner>(request_.path, options);
  const std::lock_guard lock(mutex_);
  planner_ = std::move(planner);
}

// The plan is what is left of it: the path and the planner are large.
void PlanWork::complete() {
  auto made = std::make_shared<KeptPlan>();
  made->plan = planner_->take_plan();
  static_cast<RequestRecord&>(*made) = request_;
  std::unique_ptr<planning::Planner> planner;
  {
    const std::lock_guard lock(mutex_);
    made_ = std::move(made);
    planner = std::move(planner_);
  }
  planner.reset();
  request_.path = {};
}

void PlanWork::succeed() { end(State::kDone, nullptr); }

void PlanWork::fail(std::exception_ptr reason) { end(State::kFailed, std::move(reason)); }

void PlanWork::end(State state, std::exception_ptr reason) {
  {
    const std::lock_guard lock(mutex_);
    if (state_ == State::kDone || state_ == State::kFailed) return;
    state_ = state;
    failure_ = std::move(reason);
  }
  changed_.notify_all();
}

Progress PlanWork::progress() const {
  const std::lock_guard lock(mutex_);
  Progress progress{.state = state_, .segment_count = segment_count_};
  if (planner_) progress.segments_planned = planner_->segments_planned();
  if (made_) progress.segments_planned = segment_count_;
  return progress;
}

void PlanWork::wait_for_other(State state, std::chrono::milliseconds timeout) const {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, timeout, [&] { return state_ != state; });
}

PlanPointer PlanWork::result() const {
  const std::lock_guard lock(mutex_);
  if (failure_) std::rethrow_exception(failure_);
  return made_;
}

}  // namespace kcs::jobs
