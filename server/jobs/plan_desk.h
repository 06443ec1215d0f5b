// Where requests are handed in: finds the plan, joins a planning under way, or has it planned.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <unordered_map>

#include "server/jobs/plan_keeper.h"
#include "server/jobs/plan_request.h"
#include "server/jobs/plan_work.h"
#include "server/jobs/scheduler.h"
#include "server/jobs/ticket.h"

namespace kcs::jobs {

// Brings requests, planning threads and the keeper of plans together. A request that is handed in by many at the same
// time is planned once, when it is the turn of the first of them, and stopped when the last of them has gone. Safe for
// use by many threads at once.
class PlanDesk {
 public:
  // A plan that was made and is kept.
  struct Planned {
    const KeptPlan& plan;
    const std::string& call;  // PlanRequest::call of the first who asked for it
    std::chrono::duration<double> taken;
  };
  using OnPlanned = std::function<void(const Planned&)>;

  // Keeps a reference to the keeper. on_planned: called by the threads that plan, before anyone else hears of the plan;
  // must not throw.
  PlanDesk(
      PlanKeeper& keeper, const Scheduler::Limits& limits, OnPlanned on_planned = [](const Planned&) {});
  // Stops what is under way without a ticket, and waits until it has stopped. All tickets must have gone.
  ~PlanDesk();
  PlanDesk(const PlanDesk&) = delete;
  PlanDesk& operator=(const PlanDesk&) = delete;

  // Has a request planned, unless its plan is kept already. Throws CapExceeded if too many wait.
  Ticket submit(PlanRequest request, const Client& client, Priority priority);

  // Looks on at a planning under way; nothing if there is none of that name.
  std::optional<PlanWatch> watch(const std::string& name);

  // Nobody asks any more for what goes on alone: it is stopped unless somebody holds a ticket for it. True if it was
  // stopped: then nothing is going to be kept of it. False, too, if it came to its end: then the keeper has the plan,
  // unless it failed.
  bool abandon(const std::string& name);

  Scheduler::Load load() const { return scheduler_.load(); }

 private:
  friend class PlanWatch;
  friend class Ticket;

  struct UnderWay {
    std::shared_ptr<PlanWork> work;
    JobId job = 0;
    std::map<Client, std::size_t> tickets;
    std::set<Client> alone;  // who has one more, which goes when it is abandoned
    bool ending = false;     // it is made, or has failed, and the keeper is told
  };

  std::size_t ahead(JobId job) const { return scheduler_.ahead(job); }
  void let_go_on_alone(const PlanWork& work, const Client& client);
  void drop(const PlanWork& work, const Client& client);
  UnderWay take_ticket(UnderWay& it, const Client& client);
  bool go_on(PlanWork& work, const std::stop_token& stop);
  bool begin_to_end(const PlanWork& work);
  std::exception_ptr tell_keeper(const PlanWork& work, const std::exception_ptr& failure);
  UnderWay* find(const PlanWork& work);

  PlanKeeper& keeper_;
  const OnPlanned on_planned_;
  std::mutex mutex_;
  std::condition_variable ended_;
  std::unordered_map<std::string, UnderWay> under_way_;
  Scheduler scheduler_;  // last, so that its threads are gone before anything they use
};

}  // namespace kcs::jobs
