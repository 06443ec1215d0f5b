// Plans a path while it arrives.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "server/motion/verifier.h"
#include "server/planning/corner_log.h"
#include "server/planning/horizon.h"
#include "server/planning/leg_queue.h"
#include "server/planning/marker_times.h"
#include "server/planning/options.h"
#include "server/planning/plan.h"
#include "server/planning/section.h"
#include "server/planning/toolpath.h"

namespace kcs::planning {

// As soon as enough of the path is known (horizon.h), a section of it is planned to its end, where the tool could rest;
// the first part of that is verified, settled and passed on, and the next section goes on from there. So there is
// always a verified way to rest, and it is followed if no faster one is found. What is settled depends on the path
// alone, not on how it arrives. Memory: that of a section. Time: linear in the number of segments.
// Every method that plans throws Stopped if options.stop asks for it; the planner is of no use then.
class LivePlanner {
 public:
  // `receiver` must outlive the planner; it gets phases, corners and markers, each in order. Throws InvalidInput.
  LivePlanner(const PathEnds& ends, const PlanOptions& options, PlanReceiver& receiver);

  // The next segment. Throws InvalidInput if its numbers cannot be planned, or if the tool starts too fast.
  void add(const Segment& segment);

  // How many segments and markers have come whose motion is not settled yet.
  std::size_t waiting() const { return legs_.waiting_segments() + markers_.waiting(); }

  // After the last segment: settles the rest. Throws InvalidInput if the path is too short for the speeds at its ends.
  Summary finish();

  // Where and how the motion ends; after finish().
  motion::State end_state() const;

 private:
  void check_end_speed() const;
  void begin();
  Entry entry_in_motion(const Leg& leg, MotionBuilder& builder) const;
  void settle_next();
  std::unique_ptr<Section> plan(const Horizon& horizon, CornerStrategy strategy) const;
  bool at_end(std::size_t leg) const;
  bool sees_all(const Horizon& horizon) const;
  bool settle(std::unique_ptr<Section> section, std::size_t until);
  bool follow_last();
  void go_on(const Section::Cut& from, const Section::Cut& to, std::size_t dropped);
  void pass_on(std::span<const motion::Phase> phases);
  void pass_on(std::span<const MarkerAt> markers);
  void show_path(std::size_t legs);
  void follow(motion::Verifier& verifier, std::span<const motion::Phase> phases) const;
  static void check(const std::string& fault);

  PathEnds ends_;
  PlanOptions options_;
  PlanReceiver& receiver_;
  std::size_t segments_ = 0;  // that came
  LegQueue legs_;
  MarkerTimes markers_;
  Horizon horizon_;
  std::optional<motion::Verifier> verifier_;  // from the first section on
  std::size_t shown_ = 0;                     // legs of the queue that the verifier knows
  std::unique_ptr<Section> last_;             // that was planned, and how far it is settled
  Section::Cut cut_;
  Entry entry_;  // how the next section begins, and when, s
  double time_ = 0;
  Vector end_direction_ = Vector::Zero();  // of the last leg that was settled
  std::string fault_;                      // the last that the verifier found
  Summary summary_;
  CornerLog log_;
};

}  // namespace kcs::planning
