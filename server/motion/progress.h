// How far along its path a motion has come.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "server/motion/line.h"
#include "server/motion/path.h"
#include "server/motion/phase.h"
#include "server/motion/straight_run.h"

namespace kcs::motion {

// A place that a motion has reached, from which its progress can be told on.
struct Milestone {
  double time = 0;  // s: a phase starts then
  Place place;
};

// Follows a motion phase by phase, and says at any moment of the last one which place of the path the tool is at: the
// nearest of those that it may follow and has not left behind. So the place never goes back, not where the path lies
// upon itself either; where the tool cuts a corner, it leaps over what is cut off. Where tool and path do not go the
// same way, because the path turns to and fro within the tolerance, the place may be some tolerances off.
//
// Depends on the phases since the last milestone alone, of which there is one every 64 phases. Time: constant a phase
// and a place, but where joints are passed: logarithmic in the precision. Memory: that of the segments of one phase.
class Progress {
 public:
  // From a milestone's place on, or from the start. `path` must outlive this.
  explicit Progress(const Path& path, const Place& from = {});

  // The next phase. The path must know the segments that it follows, and those from first_needed() on; if it has none,
  // there is no progress. Returns the milestone at which the phase starts, if there is one.
  std::optional<Milestone> follow(const Phase& phase);

  // Where the tool is `time` seconds after the start of the last phase, up to its duration.
  Place at(double time) const;

  // The first segment that is needed for what comes.
  std::uint32_t first_needed() const { return runs_.empty() ? next_ : runs_.front().first; }

 private:
  // Segments on one straight line.
  struct Run {
    Line line;
    std::uint32_t first, last;
  };
  // A place, by its run. Where two meet, it may be the end of one or the start of the other.
  struct Spot {
    std::uint32_t run = 0;  // counted from the last milestone
    double way = 0;         // mm
  };

  void gather(std::uint32_t last);
  void leave_behind(std::uint32_t first);
  Spot nearest(const State& state, const Spot& from, const Spot& to) const;
  // The way of the farthest place along a run between two times of the phase, mm.
  double farthest(std::uint32_t run, double early, double time) const;
  Place place(const Spot& spot) const;
  const Run& run(std::uint32_t index) const { return runs_[index - first_run_]; }

  const Path* path_;
  std::uint32_t phases_;             // since the last milestone
  std::uint32_t next_;               // segment, after the last run
  std::uint32_t first_run_ = 0;      // since the last milestone
  std::deque<Run> runs_;             // that the last phase may follow, from where it starts on
  std::optional<StraightRun> line_;  // of the last one
  Phase phase_;
  Spot start_, end_;  // of the phase
};

}  // namespace kcs::motion
