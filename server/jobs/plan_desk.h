// Where requests are handed in: finds the plan, joins a planning under way, or has it planned.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <future>
#include <mutex>
#include <string>
#include <unordered_map>

#include "server/jobs/plan_request.h"
#include "server/jobs/plan_store.h"
#include "server/jobs/worker_pool.h"

namespace kcs::jobs {

// Brings requests, planning threads and the store together. A request that is handed in twice is planned once. Safe
// for use by many threads at once. Destruction finishes the plans that are being computed and drops those that wait.
class PlanDesk {
 public:
  struct Limits {
    std::size_t threads;       // that plan, ≥ 1
    std::size_t queue_length;  // requests that may wait for one of them
    std::size_t stored_plans;
    std::uint64_t stored_bytes;
  };

  // A plan that was made.
  struct Planned {
    const KeptPlan& plan;
    const std::string& call;  // PlanRequest::call
    std::chrono::duration<double> taken;
  };
  using OnPlanned = std::function<void(const Planned&)>;

  // on_planned: called by the threads that plan.
  explicit PlanDesk(
      const Limits& limits, OnPlanned on_planned = [](const Planned&) {});

  // The plan of `request`, kept in the store once it is there. Getting the future's value throws what planning::plan()
  // throws, CapExceeded if the plan does not fit into the store, or std::future_error if the desk closed first.
  // Throws CapExceeded if too many requests wait.
  std::shared_future<PlanPointer> submit(PlanRequest request);

  PlanStore& store() { return store_; }

  // What waits to be planned, and what is being planned.
  WorkerPool::Load load() const { return pool_.load(); }

 private:
  PlanPointer plan(PlanRequest request);

  OnPlanned on_planned_;
  PlanStore store_;
  std::mutex mutex_;
  std::unordered_map<std::string, std::shared_future<PlanPointer>> under_way_;
  WorkerPool pool_;  // last, so that its threads are gone before anything they use
};

}  // namespace kcs::jobs
