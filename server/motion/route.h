// Is all of the path travelled, in order, with its rests?
#pragma once

#include <deque>
#include <span>
#include <string>

#include "server/motion/course.h"
#include "server/motion/phase.h"

namespace kcs::motion {

// Follows a motion phase by phase. Where the distance to the path says that the tool is nowhere else, this says that
// it leaves nothing out, turns round nowhere and rests where it must.
// Keeps what it saw of the joints whose pieces the last phase followed, and of the one before them; no others.
class Route {
 public:
  // slowest: the speed below which nothing moves, mm/s.
  explicit Route(double slowest) : slowest_(slowest) {}

  // Whether a phase that follows `pieces` can come next: it leaves no piece out and does not go back to one.
  bool goes_on_with(const SegmentRange& pieces) const;

  // The next phase; goes_on_with(pieces). mitres: when it passes from piece to piece (mitres.h). Returns what is wrong
  // with it, or with the joints that the motion has left behind, or nothing.
  std::string follow(const Phase& phase, const State& end, const Course& course, const SegmentRange& pieces,
                     std::span<const double> mitres);

  // After the last phase. Returns what is wrong with the end of the motion.
  std::string finish(const Course& course) const;

  // The first piece that is still needed.
  std::uint32_t first_needed() const { return first_; }

 private:
  // The end of a piece.
  struct Joint {
    bool reached = false;  // the motion came near enough
    double rested = -1;    // how long it rested there, s; negative: not at all
  };

  std::string leave_behind(const Course& course, std::uint32_t first);
  void see_joints(const Phase& phase, const State& end, const Course& course, const SegmentRange& pieces,
                  std::span<const double> mitres);
  void meet(std::uint32_t piece, const Course& course, const State& state, double standing);
  std::string judge(const Course& course, std::uint32_t piece) const;
  Joint& joint(std::uint32_t piece) { return joints_[piece - first_]; }

  double slowest_;
  bool begun_ = false;
  SegmentRange previous_;     // the last phase's pieces
  std::uint32_t first_ = 0;   // the piece of the first joint
  std::deque<Joint> joints_;  // up to that of the last piece that was followed
};

}  // namespace kcs::motion
