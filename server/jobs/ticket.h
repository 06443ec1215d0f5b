// What somebody holds who waits for a plan.
#pragma once

#include <chrono>
#include <memory>

#include "server/jobs/fair_queue.h"
#include "server/jobs/plan_work.h"

namespace kcs::jobs {

class PlanDesk;

// Looks on while a plan is made, without having it made. The desk must outlive it. Safe for use by many threads.
class PlanWatch {
 public:
  // job: of the desk's scheduler.
  PlanWatch(PlanDesk& desk, std::shared_ptr<PlanWork> work, JobId job);

  Progress progress() const;

  // Waits until the progress is another one than `last`, at the most so long, and returns it. The end is told at once,
  // other changes within a tenth of a second.
  Progress wait_for_change(const Progress& last, std::chrono::milliseconds timeout) const;

  // Waits for the end, at the most so long. True if it has come.
  bool wait(std::chrono::milliseconds timeout) const;

  // Once the end has come: the plan. Throws what planning::plan() throws, and what the keeper throws that keeps it;
  // Withdrawn if it was cancelled, or nobody waited for it any more.
  PlanPointer plan() const { return work_->result(); }

 protected:
  PlanDesk* desk_;
  std::shared_ptr<PlanWork> work_;
  JobId job_;
};

// Has a plan made: as long as somebody holds a ticket for it, or has told one to go on alone.
class Ticket : public PlanWatch {
 public:
  Ticket(PlanDesk& desk, std::shared_ptr<PlanWork> work, JobId job, Client client);
  ~Ticket();
  Ticket(Ticket&& other) noexcept = default;
  Ticket& operator=(Ticket&&) = delete;

  // The plan is made even if this goes, unless it is abandoned: somebody asks for it later.
  void go_on_alone();

 private:
  Client client_;
};

}  // namespace kcs::jobs
