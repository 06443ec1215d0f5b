#include "server/jobs/plan_desk.h"

#include <utility>

#include "server/jobs/withdrawn.h"

namespace kcs::jobs {

PlanDesk::PlanDesk(PlanKeeper& keeper, const Scheduler::Limits& limits, OnPlanned on_planned)
    : keeper_(keeper), on_planned_(std::move(on_planned)), scheduler_(limits) {}

PlanDesk::~PlanDesk() {
  std::unordered_map<std::string, UnderWay> open;  // dies after the lock is gone
  const std::lock_guard lock(mutex_);
  open.swap(under_way_);  // what stops now has not failed
}

Ticket PlanDesk::submit(PlanRequest request, const Client& client, Priority priority) {
  const std::lock_guard lock(mutex_);
  if (const auto found = under_way_.find(request.name); found != under_way_.end()) {
    UnderWay& it = found->second;
    scheduler_.join(it.job, client, priority);
    ++it.tickets[client];
    return Ticket(*this, it.work, it.job, client);
  }
  if (PlanPointer kept = keeper_.find(request.name)) {
    return Ticket(*this, std::make_shared<PlanWork>(std::move(kept)), 0, client);
  }
  const std::string name = request.name;
  const auto work = std::make_shared<PlanWork>(std::move(request));
  const JobId job =
      scheduler_.submit(client, priority, [this, work](const std::stop_token& stop) { return go_on(*work, stop); });
  under_way_.emplace(name, UnderWay{work, job, {{client, 1}}});
  return Ticket(*this, work, job, client);
}

std::optional<PlanWatch> PlanDesk::watch(const std::string& name) {
  const std::lock_guard lock(mutex_);
  const auto found = under_way_.find(name);
  if (found == under_way_.end()) return {};
  return PlanWatch(*this, found->second.work, found->second.job);
}

bool PlanDesk::abandon(const std::string& name) {
  UnderWay dropped;
  {
    std::unique_lock lock(mutex_);
    const auto found = under_way_.find(name);
    if (found == under_way_.end()) return false;
    UnderWay& it = found->second;
    if (it.ending) {
      const std::shared_ptr<PlanWork> work = it.work;
      ended_.wait(lock, [&] { return find(*work) == nullptr; });
      return false;
    }
    for (const Client& client : std::exchange(it.alone, {})) dropped = take_ticket(it, client);
  }
  if (dropped.work) dropped.work->fail(std::make_exception_ptr(Withdrawn()));
  return dropped.work != nullptr;
}

void PlanDesk::let_go_on_alone(const PlanWork& work, const Client& client) {
  const std::lock_guard lock(mutex_);
  UnderWay* it = find(work);
  if (it != nullptr && it->alone.insert(client).second) ++it->tickets[client];
}

// A ticket goes.
void PlanDesk::drop(const PlanWork& work, const Client& client) {
  UnderWay dropped;
  {
    const std::lock_guard lock(mutex_);
    UnderWay* it = find(work);
    if (it == nullptr || it->ending) return;
    dropped = take_ticket(*it, client);
  }
  if (dropped.work) dropped.work->fail(std::make_exception_ptr(Withdrawn()));
}

// Returns what is under way no more if it was the last ticket, which had better die after the lock is gone.
PlanDesk::UnderWay PlanDesk::take_ticket(UnderWay& it, const Client& client) {
  const auto tickets = it.tickets.find(client);
  if (--tickets->second > 0) return {};
  it.tickets.erase(tickets);
  scheduler_.leave(it.job, client);
  if (!it.tickets.empty()) return {};
  UnderWay last = std::move(it);
  under_way_.erase(last.work->request().name);
  return last;
}

// On a planning thread.
bool PlanDesk::go_on(PlanWork& work, const std::stop_token& stop) {
  std::exception_ptr failure;
  try {
    if (work.go_on(stop)) return true;
  } catch (...) {
    failure = std::current_exception();
  }
  if (!begin_to_end(work)) return false;
  failure = tell_keeper(work, failure);
  {
    // Before anyone hears of it: who hands it in again after a failure has it planned again.
    const std::lock_guard lock(mutex_);
    under_way_.erase(work.request().name);
  }
  ended_.notify_all();
  failure ? work.fail(failure) : work.succeed();
  return false;
}

// False if nobody wants it any more.
bool PlanDesk::begin_to_end(const PlanWork& work) {
  const std::lock_guard lock(mutex_);
  UnderWay* it = find(work);
  if (it != nullptr) it->ending = true;
  return it != nullptr;
}

// Returns what those who wait are told, instead of the plan.
std::exception_ptr PlanDesk::tell_keeper(const PlanWork& work, const std::exception_ptr& failure) {
  if (failure) {
    keeper_.refuse(work.request(), failure);
    return failure;
  }
  try {
    keeper_.keep(work.made());
  } catch (...) {
    return std::current_exception();
  }
  on_planned_({*work.made(), work.request().call, work.time()});
  return nullptr;
}

PlanDesk::UnderWay* PlanDesk::find(const PlanWork& work) {
  const auto found = under_way_.find(work.request().name);
  return found != under_way_.end() && found->second.work.get() == &work ? &found->second : nullptr;
}

}  // namespace kcs::jobs
