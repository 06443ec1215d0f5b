// Puts legs and corners together into one trajectory.
#pragma once

#include "server/motion/trajectory.h"
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

class TrajectoryBuilder {
 public:
  // Rests at `point` for `duration` seconds, if there is one, as part of a segment.
  void dwell(const Vector& point, double duration, std::uint32_t segment);

  // Moves along the leg from the end of the entry corner's zone to the beginning of the exit corner's.
  // needed_length() of the three must be at most the leg's length. The corners' zones count as parts of the leg.
  LegTimes leg(const Leg& leg, const CornerMotion& entry, const CornerMotion& exit);

  // Takes the corner at `speed` > 0.
  void corner(const CornerGeometry& geometry, const Cornering& cornering, double speed);

  void stretch(const Stretch& stretch);

  motion::Trajectory finish(const Vector& end);

 private:
  void append(motion::Phase phase, const motion::SegmentRange& segments);

  motion::Trajectory trajectory_;
  std::vector<motion::Phase> scratch_;
  double time_ = 0;
};

}  // namespace kcs::planning
