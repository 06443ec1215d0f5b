// Motions to try the verifier on: straight moves, each from rest to rest.
#pragma once

#include <vector>

#include "server/motion/trajectory.h"

namespace kcs::motion {

struct StraightMoves {
  std::vector<Phase> phases;
  Vector end = Vector::Zero();  // mm

  // Moves with a jerk of 1e4 mm/s³ along the line.
  void go(const Vector& from, const Vector& to, const SegmentRange& segments);

  void stand(double duration, const Vector& point, const SegmentRange& segments);

  Trajectory trajectory() const;

 private:
  double time() const { return phases.empty() ? 0 : phases.back().end_time(); }
};

}  // namespace kcs::motion
