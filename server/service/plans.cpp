#include "server/service/plans.h"

#include <spdlog/fmt/fmt.h>

#include <chrono>
#include <exception>
#include <optional>
#include <thread>
#include <utility>

#include "server/jobs/withdrawn.h"
#include "server/service/plan_records.h"
#include "server/service/request_code.h"
#include "server/service/status.h"
#include "server/service/violations.h"

namespace kcs::service {
namespace {

constexpr std::chrono::milliseconds kLook{10};           // how often a call that waits looks whether it is still wanted
constexpr std::chrono::milliseconds kReport{100};        // progress is told no more often
constexpr std::chrono::milliseconds kDatabaseLook{500};  // of a plan that another server makes

constexpr int kPlansPerPage = 100;
constexpr int kMostPlansPerPage = 1000;

void await(const Caller& caller, const jobs::PlanWatch& plan) {
  while (!plan.wait(kLook)) caller.require_wanted();
}

void pause(const Caller& caller, std::chrono::milliseconds time) {
  for (const auto end = std::chrono::steady_clock::now() + time; std::chrono::steady_clock::now() < end;) {
    caller.require_wanted();
    std::this_thread::sleep_for(kLook);
  }
}

std::size_t page_size_of(const v1::ListPlansRequest& request) {
  const int size = request.page_size() == 0 ? kPlansPerPage : request.page_size();
  if (size < 1 || size > kMostPlansPerPage) {
    refuse("page_size", fmt::format("is {}: give 1 to {}, or 0 for {}", size, kMostPlansPerPage, kPlansPerPage));
  }
  return static_cast<std::size_t>(size);
}

}  // namespace

v1::Plan Plans::create(const Caller& caller, Uploaded uploaded) {
  const std::string bytes = encode_request(uploaded.request, uploaded.gcode);
  uploaded.gcode = {};
  const store::Request request{
      .name = uploaded.request.name, .machine_name = uploaded.request.options.machine_name, .bytes = bytes};
  if (const auto known = archive_.record(caller.identity.owner, request.name);
      known && require_not_refused(*known).state == store::State::kFinished) {
    return encode_record(*known, v1::PLAN_STATE_READY);
  }
  jobs::Ticket ticket = desk_.submit(std::move(uploaded.request), caller.client, uploaded.priority);
  if (uploaded.accept_only) return accept(caller, request, std::move(ticket));
  await(caller, ticket);
  const jobs::PlanPointer plan = ticket.plan();
  const std::string outcome = encode_outcome(*plan);
  return encode_record(archive_.accept_finished(caller.identity.owner, request,
                                                {.plan = outcome, .cycle_time = plan->plan.summary.cycle_time}),
                       v1::PLAN_STATE_READY);
}

v1::Plan Plans::accept(const Caller& caller, const store::Request& request, jobs::Ticket ticket) {
  const store::Record record = archive_.accept(caller.identity.owner, request);
  if (record.to_plan) {
    ticket.go_on_alone();
    // A short one may have been done before the request was in the database: nothing was written down of it then.
    if (ticket.wait(kLook)) write_down(request.name, ticket);
  }
  return encode_record(require_not_refused(record), state_of(request.name));
}

void Plans::write_down(const std::string& name, const jobs::Ticket& done) {
  try {
    archive_.finish(*done.plan());
  } catch (const store::StoreError&) {
    throw;
  } catch (...) {
    archive_.refuse({.name = name}, std::current_exception());
  }
}

v1::Plan Plans::get(const Caller& caller, const std::string& name) {
  const store::Record record = find(caller, name);
  return encode_record(require_not_refused(record), state_of(name));
}

v1::ListPlansResponse Plans::list(const Caller& caller, const v1::ListPlansRequest& request) {
  const std::size_t page_size = page_size_of(request);
  const store::Filter filter = decode_filter(request.filter());
  store::Page page;
  try {
    page = archive_.list(caller.whose(), filter, page_size, request.page_token());
  } catch (const store::InvalidPageToken& invalid) {
    refuse("page_token", invalid.what());
  }
  v1::ListPlansResponse response;
  for (const store::Record& record : page.records) {
    v1::Plan& plan = *response.add_plans();
    plan = encode_record(record, state_of(record.name));
    plan.clear_notices();
  }
  response.set_next_page_token(page.next_page_token);
  return response;
}

void Plans::watch(const Caller& caller, const std::string& name, const SendProgress& send) {
  for (store::Record record = find(caller, name);; record = find(caller, name)) {
    if (require_not_refused(record).state == store::State::kFinished) {
      return send(encode_progress(encode_record(record, v1::PLAN_STATE_READY)));
    }
    if (const auto under_way = desk_.watch(name)) {
      send_progress(caller, *under_way, send);
    } else {
      v1::PlanProgress waiting;
      waiting.set_state(v1::PLAN_STATE_WAITING);
      send(waiting);
      pause(caller, kDatabaseLook);
    }
  }
}

// Until it is over.
void Plans::send_progress(const Caller& caller, const jobs::PlanWatch& watch, const SendProgress& send) const {
  jobs::Progress sent = watch.progress();
  while (!sent.over()) {
    send(encode_progress(sent));
    pause(caller, kReport);
    jobs::Progress next = watch.wait_for_change(sent, kLook);
    while (next == sent) {
      caller.require_wanted();
      next = watch.wait_for_change(sent, kLook);
    }
    sent = next;
  }
}

void Plans::remove(const Caller& caller, const std::string& name) {
  if (name.empty()) refuse("name", "is missing: give the name of a plan");
  switch (archive_.remove(caller.whose(), name)) {
    case store::Removal::kNotFound:
      throw NotKept();
    case store::Removal::kOthersKeepIt:
      return;
    case store::Removal::kGone:
      desk_.abandon(name);
      archive_.forget(name);
  }
}

jobs::PlanPointer Plans::load(const Caller& caller, const std::string& name) {
  require_not_refused(find(caller, name));
  while (true) {
    if (jobs::PlanPointer kept = archive_.find(name)) return kept;
    try {
      if (const auto under_way = desk_.watch(name)) {
        await(caller, *under_way);
        return under_way->plan();
      }
      if (const auto begun = plan_again(caller, name)) {
        await(caller, *begun);
        return begun->plan();
      }
    } catch (const jobs::Withdrawn&) {
      find(caller, name);  // those who had it made have gone, unless it was deleted
    }
  }
}

std::optional<jobs::PlanWatch> Plans::plan_again(const Caller& caller, const std::string& name) {
  const std::lock_guard lock(planning_again_);
  if (desk_.watch(name) || archive_.find(name)) return std::nullopt;
  const std::optional<std::string> bytes = archive_.request(name);
  if (!bytes) throw NotKept();
  jobs::PlanRequest request = decode_request(name, *bytes, caps_);
  request.call = caller.request_id;
  jobs::Ticket ticket = desk_.submit(std::move(request), caller.client, jobs::Priority::kNormal);
  ticket.go_on_alone();  // who gives up and asks again finds that much of it done, however short his patience
  return ticket;
}

store::Record Plans::find(const Caller& caller, const std::string& name) {
  if (name.empty()) refuse("name", "is missing: give the name of a plan");
  std::optional<store::Record> record = archive_.record(caller.whose(), name);
  if (!record) throw NotKept();
  return *std::move(record);
}

v1::PlanState Plans::state_of(const std::string& name) {
  const auto under_way = desk_.watch(name);
  if (!under_way || under_way->progress().state == jobs::Progress::State::kWaiting) return v1::PLAN_STATE_WAITING;
  return v1::PLAN_STATE_PLANNING;
}

}  // namespace kcs::service
