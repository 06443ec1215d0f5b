// Everything that is kept of plans and their runs.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/jobs/plan_cache.h"
#include "server/jobs/plan_keeper.h"
#include "server/observe/family.h"
#include "server/observe/histogram.h"
#include "server/store/store.h"

namespace kcs::service {

// The plans in memory, with their trajectories, and the database behind them: requests and what came of them. What was
// forgotten in memory is planned again from its request. Safe for use by many threads at once.
//
// Whatever asks the database throws store::StoreUnavailable until it is open, and what Store throws.
class Archive final : public jobs::PlanKeeper {
 public:
  // Keeps a reference to `durations`, which has one label, the operation.
  Archive(const store::StoreSettings& settings, jobs::PlanCache& memory,
          observe::Family<observe::Histogram>& durations);

  // Opens the database; nothing if it is open.
  void open();
  bool is_open() const { return open_ != nullptr; }

  // In memory alone.
  jobs::PlanPointer find(const std::string& name) override { return memory_.find(name); }
  // In memory, and what came of it in the database if somebody's request waits for it there.
  void keep(const jobs::PlanPointer& plan) override;
  void refuse(const jobs::RequestRecord& request, const std::exception_ptr& reason) noexcept override;
  // In memory alone.
  void forget(const std::string& name) { memory_.forget(name); }

  // Of the database: see Store.
  store::Record accept(const std::string& owner, const store::Request& request);
  store::Record accept_finished(const std::string& owner, const store::Request& request,
                                const store::Finished& finished);
  std::optional<store::Record> record(const store::Whose& whose, const std::string& name);
  std::optional<std::string> request(const std::string& name);
  store::Page list(const store::Whose& whose, const store::Filter& filter, std::size_t page_size,
                   const std::string& page_token);
  store::Removal remove(const store::Whose& whose, const std::string& name);
  store::RunRecord add_run(const store::RunRecord& run);
  void update_run(const store::RunRecord& run);
  std::optional<store::RunRecord> find_run(const std::string& name);
  std::optional<store::RunRecord> open_run(const std::string& machine);
  std::vector<std::string> claim(std::size_t most);
  void release();
  // Forgets in memory, too, what it swept.
  void sweep();
  // Writes down what came of a plan that is in memory.
  void finish(const jobs::KeptPlan& plan);

 private:
  void write_refusal(const std::string& name);
  template <typename Work>
  auto timed(const char* operation, const Work& work);
  store::Store& database();

  const store::StoreSettings settings_;
  jobs::PlanCache& memory_;
  observe::Family<observe::Histogram>& durations_;
  std::unique_ptr<store::Store> store_;
  std::atomic<store::Store*> open_ = nullptr;  // store_ once it is there
};

// What the database keeps of a plan.
std::string encode_outcome(const jobs::KeptPlan& plan);

}  // namespace kcs::service
