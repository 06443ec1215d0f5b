// Is all of the path travelled, in order, with its rests?
#pragma once

#include <string>
#include <vector>

#include "server/motion/course.h"
#include "server/motion/phase.h"

namespace kcs::motion {

// Follows a trajectory phase by phase. Where the distance to the path says that the tool is nowhere else, this says
// that it leaves nothing out, turns round nowhere and rests where it must.
class Route {
 public:
  // `course` must outlive the route. slowest: the speed below which nothing moves, mm/s.
  Route(const Course& course, double slowest);

  // `pieces` are the phase's own. Returns what is wrong with it, or nothing.
  std::string follow(const Phase& phase, const SegmentRange& pieces);

  // After the last phase.
  std::string finish() const;

 private:
  std::string check_order(const SegmentRange& pieces);
  std::string check_forward(const Phase& phase, const Piece& piece) const;
  void visit_joints(const Phase& phase, const SegmentRange& pieces);
  void pass(std::size_t joint, const State& state, double standing);

  // The end of each piece but the last.
  struct Joint {
    double nearest;      // how near the motion came, mm
    double rested = -1;  // how long it rested there, s; negative: not at all
  };

  const Course& course_;
  double slowest_;
  bool begun_ = false;
  SegmentRange previous_;
  std::vector<Joint> joints_;
};

}  // namespace kcs::motion
