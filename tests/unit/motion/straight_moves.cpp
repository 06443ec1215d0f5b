#include "tests/unit/motion/straight_moves.h"

#include <cmath>

#include "server/motion/jlap.h"

namespace kcs::motion {

void StraightMoves::go(const Vector& from, const Vector& to, const SegmentRange& segments) {
  const double length = (to - from).norm();
  const Vector direction = (to - from) / length;
  // Up to the middle with jerk J, −J, −J, J: four phases of the same duration t; length = 2 J t³.
  const double t = std::cbrt(length / 2e4);
  LinearState state;
  for (const double jerk : {1e4, -1e4, -1e4, 1e4}) {
    const LinearPhase linear{t, jerk};
    Phase phase{.start_time = time(), .duration = t, .segments = segments};
    phase.start = {from + state.position * direction, state.velocity * direction, state.acceleration * direction};
    phase.jerk = jerk * direction;
    phases.push_back(phase);
    state = linear.end(state);
  }
  end = to;
}

void StraightMoves::stand(double duration, const Vector& point, const SegmentRange& segments) {
  phases.push_back({time(), duration, {.position = point}, Vector::Zero(), segments});
}

Trajectory StraightMoves::trajectory() const {
  Trajectory trajectory;
  for (const Phase& phase : phases) trajectory.append(phase);
  trajectory.set_final_state({.position = end});
  return trajectory;
}

}  // namespace kcs::motion
