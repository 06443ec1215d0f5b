// Whose plans they are.
#pragma once

#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <unordered_map>

#include "server/jobs/plan_request.h"
#include "server/security/identity.h"

namespace kcs::service {

// Knows the owners of each plan, for as long as anybody holds the plan. The same request made by two owners gives one
// plan that belongs to both. Safe for use by many threads at once.
class PlanOwners {
 public:
  void add(const jobs::PlanPointer& plan, const std::string& owner);

  // Whether `plan` is the caller's own, or the caller an administrator.
  bool sees(const security::Identity& caller, const std::string& plan);

  // The plan is not the caller's any more; an administrator takes it from all. True if nobody is left.
  bool remove(const security::Identity& caller, const std::string& plan);

 private:
  struct Entry {
    std::weak_ptr<const jobs::KeptPlan> plan;
    std::set<std::string> owners;
  };

  std::mutex mutex_;
  std::unordered_map<std::string, Entry> by_plan_;
};

}  // namespace kcs::service
