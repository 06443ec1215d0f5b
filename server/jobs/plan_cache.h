// The plans that the server has at hand.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <mutex>
#include <string>
#include <unordered_map>

#include "server/jobs/plan_keeper.h"
#include "server/jobs/plan_request.h"

namespace kcs::jobs {

// Plans by their names, in memory, within a bound on their number and on their size. Where a new one needs room, the
// one that was not used for longest goes: its request makes it again. Safe for use by many threads at once.
class PlanCache final : public PlanKeeper {
 public:
  PlanCache(std::size_t max_plans, std::uint64_t max_bytes);

  // The plan, which counts as used now; null if it is not kept.
  PlanPointer find(const std::string& name) override;

  // Keeps `plan`. Throws CapExceeded if it is larger than the whole cache.
  void keep(const PlanPointer& plan) override;

  // Forgets the plan; whoever holds it keeps it alive. False if it is not kept.
  bool forget(const std::string& name);

 private:
  struct Entry {
    PlanPointer plan;
    std::uint64_t bytes;
  };
  using Entries = std::list<Entry>;

  // Takes the entry out of the cache.
  Entry remove(Entries::iterator entry);

  const std::size_t max_plans_;
  const std::uint64_t max_bytes_;
  std::mutex mutex_;
  Entries entries_;  // used latest first
  std::unordered_map<std::string, Entries::iterator> by_name_;
  std::uint64_t bytes_ = 0;
};

}  // namespace kcs::jobs
