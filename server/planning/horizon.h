// How far a path must be known so that its first part can be settled.
#pragma once

#include <cstddef>
#include <optional>

#include "server/motion/limits.h"
#include "server/planning/leg_queue.h"
#include "server/planning/sharp_turns.h"

namespace kcs::planning {

// Counted in the time that the tool would take at the feed and in sharp corners, and in legs: first what may be
// settled, then what is looked at beyond it. Where it will be far slower than the feed, also in the time that it takes
// then. Looks at each leg once while the path arrives.
class Horizon {
 public:
  // share: of the usual distances, > 0. settled: the share of that of the time that may be settled, > 0. legs: so many
  // are seen at least, because the verifier was shown them and asks for them.
  explicit Horizon(const motion::AxisLimits& limits, double share = 1, double settled = 1, std::size_t legs = 0)
      : limits_(limits), share_(share), settled_(settled), at_least_(legs) {}

  // Whether the path is known far enough: to the horizon, or to its end. Legs may have been added since the last call,
  // but none dropped.
  bool in_sight(const LegQueue& queue);

  // Once in sight: the last leg that may be settled, and how many legs the plan has to see. One more is known, unless
  // these are all.
  std::size_t until() const { return until_; }
  std::size_t legs() const { return legs_; }

 private:
  void see(const Leg& leg);
  // Of time, with the corner before the leg.
  double steps_of(const Leg& leg);
  void reach(const Leg& leg);
  void look_farther(const Leg& leg);
  bool beyond() const;

  motion::AxisLimits limits_;
  double share_, settled_;
  std::size_t at_least_;
  std::size_t legs_ = 0, until_ = 0;
  bool ahead_ = false;          // what may be settled has come; the rest is looked at
  double steps_ = 0, way_ = 0;  // steps of time; mm
  double slow_steps_ = 0;       // of time, at the speeds that bends allow
  double segments_ = 0;
  std::optional<Leg> last_leg_;
  double speed_ = 0;         // that the tool may reach on the last leg, mm/s
  double first_feed_ = 0;    // where what is settled ends, mm/s
  double stopping_way_ = 0;  // from there, mm
  SharpTurns turns_;
};

}  // namespace kcs::planning
