#include "server/jobs/ticket.h"

#include <algorithm>
#include <utility>

#include "server/jobs/plan_desk.h"

namespace kcs::jobs {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// How often progress is looked at that nobody announces.
constexpr milliseconds kLook{100};

}  // namespace

PlanWatch::PlanWatch(PlanDesk& desk, std::shared_ptr<PlanWork> work, JobId job)
    : desk_(&desk), work_(std::move(work)), job_(job) {}

Progress PlanWatch::progress() const {
  Progress progress = work_->progress();
  if (progress.state == Progress::State::kWaiting) progress.requests_ahead = desk_->ahead(job_);
  return progress;
}

Progress PlanWatch::wait_for_change(const Progress& last, milliseconds timeout) const {
  const auto end = steady_clock::now() + timeout;
  while (true) {
    const Progress now = progress();
    const auto left = std::chrono::ceil<milliseconds>(end - steady_clock::now());
    if (now != last || left <= milliseconds(0)) return now;
    work_->wait_for_other(now.state, std::min(kLook, left));
  }
}

bool PlanWatch::wait(milliseconds timeout) const {
  const auto end = steady_clock::now() + timeout;
  while (true) {
    const Progress now = work_->progress();
    const auto left = std::chrono::ceil<milliseconds>(end - steady_clock::now());
    if (now.over() || left <= milliseconds(0)) return now.over();
    work_->wait_for_other(now.state, left);
  }
}

Ticket::Ticket(PlanDesk& desk, std::shared_ptr<PlanWork> work, JobId job, Client client)
    : PlanWatch(desk, std::move(work), job), client_(std::move(client)) {}

// One that was moved from has no work.
Ticket::~Ticket() {
  if (work_) desk_->drop(*work_, client_);
}

void Ticket::go_on_alone() { desk_->let_go_on_alone(*work_, client_); }

}  // namespace kcs::jobs
