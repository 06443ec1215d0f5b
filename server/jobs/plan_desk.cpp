#include "server/jobs/plan_desk.h"

#include <chrono>
#include <exception>
#include <memory>
#include <utility>

#include "server/planning/planner.h"

namespace kcs::jobs {

PlanDesk::PlanDesk(const Limits& limits, OnPlanned on_planned)
    : on_planned_(std::move(on_planned)),
      store_(limits.stored_plans, limits.stored_bytes),
      pool_(limits.threads, limits.queue_length) {}

std::shared_future<PlanPointer> PlanDesk::submit(PlanRequest request) {
  const std::string name = request.name;
  // std::function wants to be copied, a promise and a large request do not.
  const auto promise = std::make_shared<std::promise<PlanPointer>>();
  const auto work = std::make_shared<PlanRequest>(std::move(request));

  const std::lock_guard lock(mutex_);
  if (const auto found = under_way_.find(name); found != under_way_.end()) return found->second;
  std::shared_future<PlanPointer> result = promise->get_future().share();
  if (PlanPointer kept = store_.find(name)) {
    promise->set_value(std::move(kept));
    return result;
  }
  pool_.submit([this, promise, work] {
    const std::string finished = work->name;
    const auto leave = [this, &finished] {
      const std::lock_guard guard(mutex_);
      under_way_.erase(finished);
    };
    try {
      PlanPointer kept = plan(std::move(*work));
      leave();
      promise->set_value(std::move(kept));
    } catch (...) {
      leave();
      promise->set_exception(std::current_exception());
    }
  });
  under_way_.emplace(name, result);
  return result;
}

PlanPointer PlanDesk::plan(PlanRequest request) {
  const auto began = std::chrono::steady_clock::now();
  const std::string call = std::move(request.call);
  auto made = std::make_shared<KeptPlan>();
  made->plan = planning::plan(request.path, request.options.planning);
  static_cast<RequestRecord&>(*made) = std::move(request);
  store_.keep(made);
  on_planned_({*made, call, std::chrono::steady_clock::now() - began});
  return made;
}

}  // namespace kcs::jobs
