#include "server/service/plan_owners.h"

namespace kcs::service {

void PlanOwners::add(const jobs::PlanPointer& plan, const std::string& owner) {
  const std::lock_guard lock(mutex_);
  std::erase_if(by_plan_, [](const auto& entry) { return entry.second.plan.expired(); });
  Entry& entry = by_plan_[plan->name];
  entry.plan = plan;
  entry.owners.insert(owner);
}

bool PlanOwners::sees(const security::Identity& caller, const std::string& plan) {
  if (caller.is_admin()) return true;
  const std::lock_guard lock(mutex_);
  const auto found = by_plan_.find(plan);
  return found != by_plan_.end() && found->second.owners.contains(caller.owner);
}

bool PlanOwners::remove(const security::Identity& caller, const std::string& plan) {
  const std::lock_guard lock(mutex_);
  const auto found = by_plan_.find(plan);
  if (found == by_plan_.end()) return true;
  if (!caller.is_admin()) found->second.owners.erase(caller.owner);
  if (!caller.is_admin() && !found->second.owners.empty()) return false;
  by_plan_.erase(found);
  return true;
}

}  // namespace kcs::service
