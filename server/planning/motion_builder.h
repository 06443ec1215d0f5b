// Puts legs, corners and stretches together into one motion.
#pragma once

#include <utility>
#include <vector>

#include "server/motion/jlap.h"
#include "server/motion/phase.h"
#include "server/planning/corner_motion.h"
#include "server/planning/cornering.h"
#include "server/planning/leg.h"
#include "server/planning/stretch.h"

namespace kcs::planning {

// How much longer a leg takes than at its feed from end to end, s, split where it is fastest.
struct LegTimes {
  double entry_lost = 0;  // after the entry corner
  double exit_lost = 0;   // before the exit corner
  double at_feed = 0;     // time at the feed, s
};

class MotionBuilder {
 public:
  // time: s, when the motion begins.
  explicit MotionBuilder(double time) : time_(time) {}

  // Rests at `point` for `duration` seconds, if there is one, as part of a segment.
  void dwell(const Vector& point, double duration, std::uint32_t segment);

  // Moves along the leg from the end of the entry corner's zone to the beginning of the exit corner's.
  // needed_length() of the three must be at most the leg's length. The corners' zones count as parts of the leg.
  LegTimes leg(const Leg& leg, const CornerMotion& entry, const CornerMotion& exit);

  // Takes the corner at `speed` > 0.
  void corner(const CornerGeometry& geometry, const Cornering& cornering, double speed);

  // What is not settled of it yet.
  void stretch(const Stretch& stretch);

  // From a state on the leg to one without acceleration, as fast as the leg's jerk allows; returns it.
  motion::LinearState settle(const Leg& leg, const motion::LinearState& start);

  // What there is so far, in order of time.
  const std::vector<motion::Phase>& phases() const { return phases_; }
  std::vector<motion::Phase> take() { return std::move(phases_); }

 private:
  void append(motion::Phase phase, const motion::SegmentRange& segments);

  double time_;
  std::vector<motion::Phase> phases_;
  std::vector<motion::Phase> scratch_;
};

}  // namespace kcs::planning
