// How a corner is taken: a family of motions, one for each speed from rest to the fastest that the limits and the
// tolerance allow. The look-ahead picks the speed.
#pragma once

#include <variant>

#include "server/planning/blended.h"
#include "server/planning/corner_geometry.h"
#include "server/planning/interrupted.h"
#include "server/planning/options.h"
#include "server/planning/uninterrupted.h"

namespace kcs::planning {

// Rest on the point.
struct ExactStop {};

// Straight on, at most at `speed` (mm/s): where two feeds meet.
struct Passage {
  double speed = 0;
};

// It is settled already.
struct Settled {
  CornerMotion motion;
};

class Cornering {
 public:
  Cornering() = default;  // an exact stop
  explicit Cornering(const Settled& settled) : way_(settled) {}
  explicit Cornering(const Passage& passage) : way_(passage) {}
  explicit Cornering(const Interrupted& way) : way_(way) {}
  explicit Cornering(const Uninterrupted& way) : way_(way) {}
  explicit Cornering(const Blended& way) : way_(way) {}

  // mm/s
  double max_speed() const;

  // The corner at `speed` (mm/s, 0 to max_speed()). Time, length and boundary acceleration grow with speed.
  CornerMotion at(double speed) const;

  // The fastest speed (mm/s, at most max_speed()) from which `level` (mm/s, ≥ 0) suffices: arriving at speed V while
  // already braking with Ac needs a leg on which the tool was as fast as V + Ac²/(2J), its level there.
  double speed_at_level(double level, double leg_jerk) const;

  // Writes the corner's phases at `speed` > 0 to `phases`, without times and segments; none for a passage and for
  // what is settled.
  void append_phases(const CornerGeometry& corner, double speed, std::vector<motion::Phase>& phases) const;

  bool is_passage() const { return std::holds_alternative<Passage>(way_); }
  // Never kAuto; a passage and what is settled count as kInterrupted.
  CornerStrategy strategy() const;

 private:
  std::variant<ExactStop, Passage, Settled, Interrupted, Uninterrupted, Blended> way_;
};

// The fastest family of the given strategy for a corner; for kAuto the fastest of all, judged by the time from the
// middle of one leg to the middle of the other as if the legs' far ends had corners like this one. For a corner that
// blends do not suit, kBlended is the faster of the paper's two.
Cornering choose_cornering(const CornerGeometry& corner, CornerStrategy strategy, const AxisLimits& limits);

}  // namespace kcs::planning
