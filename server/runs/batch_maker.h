// Cuts a plan into batches of setpoints, each with the way to rest from its end.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "server/motion/limits.h"
#include "server/planning/plan.h"
#include "server/runs/batch_markers.h"
#include "server/runs/clock_course.h"
#include "server/runs/plan_window.h"

namespace kcs::runs {

struct BatchOptions {
  double period = 0.001;             // between two setpoints, s
  std::size_t setpoints = 20;        // of a batch
  std::size_t tail_capacity = 4000;  // setpoints of a stop tail, at most

  bool operator==(const BatchOptions&) const = default;
};

struct Batch {
  std::vector<motion::Vector> positions;  // mm; the first one a period after the state that the batch goes on from
  std::vector<motion::Vector> tail;       // mm; empty if the batch ends at rest
  ClockState end;                         // at the last setpoint
  double tail_end = 0;                    // where in the plan the tail comes to rest, s
  bool end_of_plan = false;               // the last setpoint is the end of the path
  std::vector<BatchMarker> markers;       // in the order of the setpoints
};

// Batches of one plan for one machine. A batch depends on the plan, the state that it goes on from and the rate alone:
// who knows that state can go on from it, on any server. Dwells last as long as planned at any rate; at the rate 0 the
// run waits at a dwell's end. Every batch and every tail was verified against the limits of
// the plan, exactly (paced_motion.h). For one thread.
class BatchMaker {
 public:
  // The plan must outlive it. limits: those that it was made with.
  BatchMaker(const planning::Plan& plan, const motion::AxisLimits& limits, const BatchOptions& options);

  // The next batch, on the way to `rate` (≥ 0). Where none is found, and then the pace was above the plan's, it follows
  // the way to rest. Nothing if there is no such way within the tail's capacity; that does not happen behind a batch.
  std::optional<Batch> next(const ClockState& from, double rate);

 private:
  struct Care;
  std::optional<Batch> next(const ClockState& from, double rate, const Care& care);
  std::optional<ClockCourse> lead(const ClockState& from, double rate, const Care& care);
  std::optional<ClockCourse> stop(const ClockState& from, const Care& care);
  double step(const Care& care) const;
  bool verified(const ClockCourse& course);
  Batch batch(const ClockState& from, const ClockCourse& course, const ClockCourse& tail);
  static void settle(std::vector<double>& times, std::size_t count, double end);
  std::vector<motion::Vector> sample(const ClockCourse& course, std::size_t count, std::vector<double>& times);
  double duration() const { return static_cast<double>(options_.setpoints) * options_.period; }
  bool has_ended(const ClockState& state) const { return state.plan_time >= plan_.duration(); }
  // Likewise beyond the end.
  bool dwells(const ClockState& state) { return plan_.phase(plan_.find(state.plan_time)).rests(); }
  bool at_rest(const ClockState& state) { return state.rests() || dwells(state); }

  motion::AxisLimits limits_;
  BatchOptions options_;
  PlanWindow plan_;
  const std::vector<planning::MarkerAt>& markers_;
};

}  // namespace kcs::runs
