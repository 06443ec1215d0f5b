// The legs of a path that is still arriving.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "server/motion/straight_run.h"
#include "server/motion/verifier.h"
#include "server/planning/leg.h"
#include "server/planning/toolpath.h"

namespace kcs::planning {

// Breaks a path into legs, segment by segment, and keeps them until they are dropped. Segments of no length are left
// out; what they say of stops and dwells counts.
class LegQueue {
 public:
  // start: of the path, mm.
  LegQueue(const Vector& start, const AxisLimits& limits) : start_(start), end_(start), limits_(limits) {}

  // The next segment. Its numbers must be valid (validation.h). Returns whether it moves.
  bool add(const Segment& segment);

  // Nothing more comes: the last leg is complete.
  void finish() { finished_ = true; }
  bool finished() const { return finished_; }

  // Complete legs, counted from the first that is not dropped: nothing that still comes changes them.
  std::size_t size() const { return finished_ || legs_.empty() ? legs_.size() : legs_.size() - 1; }
  const Leg& leg(std::size_t i) const { return legs_[i]; }
  const Joint& joint(std::size_t i) const { return joints_[i]; }
  // The first so many legs; count ≤ size().
  LegPath first(std::size_t count) const;
  // The segments of a leg, as the verifier wants to know them. reach: mm, how near the motion must come to its end.
  template <class Take>
  void segments_of(std::size_t leg, double reach, const Take& take) const;
  void drop(std::size_t count);

  const Vector& start() const { return start_; }                 // of the path, mm
  const Vector& end() const { return end_; }                     // of what has come, mm
  double initial_dwell() const { return initial_dwell_; }        // s, before anything moves
  bool initial_stop() const { return initial_stop_; }            // asked for before anything moves
  std::size_t waiting_segments() const { return ends_.size(); }  // of the legs that are kept
  std::uint32_t segments() const { return first_segment_ + static_cast<std::uint32_t>(ends_.size()); }  // that move

 private:
  Vector start_, end_;
  AxisLimits limits_;
  bool finished_ = false;
  double initial_dwell_ = 0;
  bool initial_stop_ = false;
  std::deque<Leg> legs_;
  std::deque<Joint> joints_;
  std::deque<Vector> ends_;                 // of the segments of the legs that are kept, mm
  std::uint32_t first_segment_ = 0;         // of the whole path, to which ends_.front() belongs
  Segment last_;                            // that moved
  std::optional<motion::StraightRun> run_;  // of the last leg
};

template <class Take>
void LegQueue::segments_of(std::size_t leg, double reach, const Take& take) const {
  const Leg& it = legs_[leg];
  for (std::uint32_t i = it.segments.first; i <= it.segments.last; ++i) {
    const bool last = i == it.segments.last;
    take(motion::PathSegment{.end = ends_[i - first_segment_],
                             .feed = it.programmed_feed,
                             .tolerance = it.tolerance,
                             .reach = last ? reach : 0,
                             .rest = last && joints_[leg].stop ? joints_[leg].dwell : -1});
  }
}

}  // namespace kcs::planning
