// Where plans go when they are made.
#pragma once

#include <exception>
#include <string>

#include "server/jobs/plan_request.h"

namespace kcs::jobs {

// What a desk (plan_desk.h) hands its results to. Its methods are called by many threads at once.
class PlanKeeper {
 public:
  virtual ~PlanKeeper() = default;

  // The plan; null if it is not kept. Should be quick: nobody can hand in a request meanwhile.
  virtual PlanPointer find(const std::string& name) = 0;

  // Keeps a plan. Nobody hears that it is made before this returns; if it throws, that is what they hear instead.
  virtual void keep(const PlanPointer& plan) = 0;

  // Takes note that a request cannot be planned, and what planning threw. Nobody hears of it before this returns.
  // Needed only by a keeper that tells it to somebody who does not wait: whoever asks again is refused again. That it
  // cannot be noted is therefore for the keeper to report, and changes nothing for those who wait.
  virtual void refuse(const RequestRecord& /*request*/, const std::exception_ptr& /*reason*/) noexcept {}
};

}  // namespace kcs::jobs
