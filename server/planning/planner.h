// Plans a whole path bit by bit.
#pragma once

#include <atomic>
#include <cstddef>
#include <stop_token>
#include <utility>

#include "server/motion/progress.h"
#include "server/planning/live_planner.h"
#include "server/planning/options.h"
#include "server/planning/plan.h"
#include "server/planning/plan_receiver.h"
#include "server/planning/toolpath.h"

namespace kcs::planning {

// Plans a path bit by bit, so that whoever has other things to do can do them in between.
class Planner final : PlanReceiver {
 public:
  // `path` must outlive the planner.
  // Throws InvalidInput if a number is not finite or outside its range (options.h), naming the segment.
  Planner(const Toolpath& path, const PlanOptions& options);

  // Goes on with the next segment, or comes to the end of the path: mostly microseconds, now and then, when enough of
  // the path is known to plan a section of it, some milliseconds, at worst seconds. True if there is more to do.
  // Throws what plan() throws; there is nothing to go on with then.
  bool go_on();

  // So many segments of the path are planned and verified: never less than before. May be called from any thread.
  std::size_t segments_planned() const { return segments_planned_.load(std::memory_order_relaxed); }

  // The plan, once there is nothing more to do.
  Plan take_plan() { return std::move(plan_); }

 private:
  void take(const Segment& segment) override;
  void take(const motion::Phase& phase) override;
  void take(const Corner& corner) override;
  void take(const MarkerAt& marker) override;

  const Toolpath& path_;
  std::stop_token stop_;
  Plan plan_;
  motion::Progress progress_{plan_.path};
  LivePlanner planner_;
  std::size_t next_ = 0;  // segment
  std::atomic<std::size_t> segments_planned_ = 0;
};

}  // namespace kcs::planning
