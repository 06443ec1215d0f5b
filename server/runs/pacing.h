// Changes the pace of a run as fast as the axes allow.
#pragma once

#include <optional>

#include "server/motion/limits.h"
#include "server/runs/bend_range.h"
#include "server/runs/clock_course.h"
#include "server/runs/plan_window.h"

namespace kcs::runs {

// Leads a plan's clock from any state that it came into towards a rate, step by step. Each step bends the rate as hard
// as the axes allow, but only so hard that it can be made steady again from there, before the plan itself needs what
// the change of pace uses of the limits. A steady rate up to 1 is inside the limits for ever. A higher one is kept only
// where it can be left in time for what comes. A dwell takes the time that is programmed: a stretch ends where one
// begins, whatever the rate then is; the clock jumps to the rate 1, and at the dwell's end to the rate wanted, but to
// none above 1, so that the motion begins inside its limits. What comes out depends on the plan and the state alone; it
// is to be verified (paced_motion.h).
class Pacing {
 public:
  // step: the time between two decisions, s. share: of the limits that a change of pace uses. All must outlive it.
  Pacing(PlanWindow& plan, const motion::AxisLimits& limits, double step, double share)
      : plan_(plan), limits_(limits), step_(step), share_(share) {}

  // Goes on with the next stretch towards `rate` (≥ 0), of at most `longest` seconds; false if none is found.
  bool lead(ClockCourse& course, double rate, double longest);

 private:
  void dwell(ClockCourse& course, double rate, double longest);
  std::optional<ClockPhase> next(const ClockState& from, double rate, double longest);
  static ClockState after(const ClockPhase& stretch, double rate);
  BendRange range(const ClockState& state, double step);
  std::optional<ClockPhase> landing(const ClockState& from, double rate, double longest);
  ClockPhase hardest(const ClockState& from, double hard, double soft, double rate, double step);
  bool holds(ClockPhase phase);
  std::optional<ClockState> steadied(ClockState state);
  bool returns_to_plan(ClockState state);
  bool is_safe(const ClockPhase& phase);
  bool is_safe(const ClockPhase& phase, double rate);

  PlanWindow& plan_;
  const motion::AxisLimits& limits_;
  double step_, share_;
};

}  // namespace kcs::runs
