// Plans as callers know them: made once, kept, listed, brought back.
#pragma once

#include <kcs/v1/planning.pb.h>

#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "server/jobs/plan_desk.h"
#include "server/service/archive.h"
#include "server/service/caller.h"
#include "server/service/caps.h"
#include "server/service/upload.h"

namespace kcs::service {

// Joins the desk, where plans are made, and the archive, where they are kept. A caller sees the plans of his owner
// alone. Every method throws what end_by_current_exception() knows (status.h), NotKept where a plan is not the
// caller's. Safe for use by many threads at once.
class Plans {
 public:
  // Keeps references to all of them. archive: the desk's keeper.
  Plans(jobs::PlanDesk& desk, Archive& archive, const Caps& caps) : desk_(desk), archive_(archive), caps_(caps) {}

  // Has a request planned, and waits for it unless it is only to be accepted. When this returns, the request is kept.
  v1::Plan create(const Caller& caller, Uploaded uploaded);

  v1::Plan get(const Caller& caller, const std::string& name);
  v1::ListPlansResponse list(const Caller& caller, const v1::ListPlansRequest& request);

  // Hands what changes to `send`, until the plan is there.
  using SendProgress = std::function<void(const v1::PlanProgress&)>;
  void watch(const Caller& caller, const std::string& name, const SendProgress& send);

  // The caller has it no more; it is no longer made or kept if nobody else has it either.
  void remove(const Caller& caller, const std::string& name);

  // With its trajectory, which is planned again if memory has lost it; waits for one that is being made.
  jobs::PlanPointer load(const Caller& caller, const std::string& name);

 private:
  v1::Plan accept(const Caller& caller, const store::Request& request, jobs::Ticket ticket);
  // What came of an accepted request; nothing if that is known already.
  void write_down(const std::string& name, const jobs::Ticket& done);
  store::Record find(const Caller& caller, const std::string& name);
  // What the desk knows of a plan without outcome.
  v1::PlanState state_of(const std::string& name);
  void send_progress(const Caller& caller, const jobs::PlanWatch& watch, const SendProgress& send) const;
  // Nothing if somebody else has had it planned since the caller looked for it.
  std::optional<jobs::PlanWatch> plan_again(const Caller& caller, const std::string& name);

  jobs::PlanDesk& desk_;
  Archive& archive_;
  const Caps& caps_;
  std::mutex planning_again_;  // many who want the same plan need its request once
};

}  // namespace kcs::service
