#include "server/jobs/plan_cache.h"

#include <iterator>
#include <utility>
#include <vector>

#include "server/jobs/cap_exceeded.h"

namespace kcs::jobs {
namespace {

std::uint64_t size_of(const KeptPlan& plan) {
  std::uint64_t bytes = sizeof(KeptPlan) + plan.name.capacity() + plan.options.machine_name.capacity();
  bytes += plan.plan.trajectory.bytes();
  bytes += plan.plan.path.bytes();
  bytes += plan.plan.milestones.capacity() * sizeof(motion::Milestone);
  bytes += plan.plan.corners.bytes();
  bytes += plan.plan.markers.capacity() * sizeof(planning::MarkerAt);
  for (const gcode::Notice& notice : plan.notices) bytes += sizeof(gcode::Notice) + notice.text.capacity();
  return bytes;
}

}  // namespace

PlanCache::PlanCache(std::size_t max_plans, std::uint64_t max_bytes) : max_plans_(max_plans), max_bytes_(max_bytes) {}

PlanPointer PlanCache::find(const std::string& name) {
  const std::lock_guard lock(mutex_);
  const auto found = by_name_.find(name);
  if (found == by_name_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, found->second);
  return found->second->plan;
}

void PlanCache::keep(const PlanPointer& plan) {
  const std::uint64_t bytes = size_of(*plan);
  if (bytes > max_bytes_) {
    throw CapExceeded("cached_bytes", max_bytes_,
                      "this plan alone takes " + std::to_string(bytes) + " bytes; send the program in parts");
  }
  std::vector<Entry> forgotten;  // dies after the lock is gone: freeing a large plan takes a while
  const std::lock_guard lock(mutex_);
  if (const auto found = by_name_.find(plan->name); found != by_name_.end()) forgotten.push_back(remove(found->second));
  while (!entries_.empty() && (entries_.size() >= max_plans_ || bytes_ + bytes > max_bytes_)) {
    forgotten.push_back(remove(std::prev(entries_.end())));
  }
  entries_.push_front({plan, bytes});
  by_name_[plan->name] = entries_.begin();
  bytes_ += bytes;
}

bool PlanCache::forget(const std::string& name) {
  Entry forgotten;
  const std::lock_guard lock(mutex_);
  const auto found = by_name_.find(name);
  if (found == by_name_.end()) return false;
  forgotten = remove(found->second);
  return true;
}

PlanCache::Entry PlanCache::remove(Entries::iterator entry) {
  Entry removed = std::move(*entry);
  by_name_.erase(removed.plan->name);
  bytes_ -= removed.bytes;
  entries_.erase(entry);
  return removed;
}

}  // namespace kcs::jobs
