// The programmed path as a motion is judged by it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "server/motion/line.h"
#include "server/motion/phase.h"
#include "server/motion/straight_run.h"

namespace kcs::motion {

// A straight segment of the programmed path, from the end of the one before it.
struct PathSegment {
  Vector end = Vector::Zero();  // mm
  double feed = 0;              // mm/s
  double tolerance = 0;         // mm: the largest contour error of a phase that follows the segment
  double reach = 0;             // mm: how near the motion must come to the end
  double rest = -1;             // s: how long the tool must rest on the end, exactly; negative: no rest
};

// Segments that lie on one line and agree, taken together: a curve that passes from one to the next is near to the
// line all the time.
struct Piece {
  Piece(const Vector& from, const PathSegment& segment, std::uint32_t index);

  // Goes on with the segment `index`, which lies on the same line.
  void extend(const PathSegment& segment, std::uint32_t index);

  Line line;
  double feed;                 // mm/s
  double tolerance;            // mm
  double reach;                // mm, of the end
  double rest;                 // s, at the end
  double rounding;             // what cannot be told about a distance to it, because of its coordinates' rounding, mm
  std::uint32_t last_segment;  // counted from 0
};

// The pieces of a path, in order, counted from 0; those that are no longer needed can be forgotten.
class Course {
 public:
  explicit Course(const Vector& start) : end_(start) {}

  // Goes on with the next segment.
  void add(const PathSegment& segment);

  const Vector& end() const { return end_; }  // of the path so far, mm
  std::uint32_t segments() const { return segments_; }
  std::uint32_t pieces() const { return first_ + static_cast<std::uint32_t>(window_.size() - begin_); }

  // The number of segments whose pieces nothing can be added to, because other pieces follow them.
  std::uint32_t settled_segments() const;

  // The pieces of a range of segments; segments.last < segments(), and the pieces are not forgotten.
  SegmentRange pieces_of(const SegmentRange& segments) const;
  const Piece& piece(std::uint32_t index) const { return window_[begin_ + (index - first_)]; }
  std::span<const Piece> part(const SegmentRange& pieces) const {
    return {&piece(pieces.first), pieces.last - pieces.first + 1};
  }

  // The first piece that is not forgotten.
  std::uint32_t first_piece() const { return first_; }
  // Forgets the pieces before piece `index` ≤ pieces(). Constant time a piece, all in all.
  void forget_before(std::uint32_t index);

 private:
  Vector end_;
  std::uint32_t segments_ = 0;
  std::uint32_t first_ = 0;  // the first piece that is kept…
  std::size_t begin_ = 0;    // …and where in the window: what is before it waits to be thrown away
  std::vector<Piece> window_;
  std::optional<StraightRun> run_;  // of the last piece
};

}  // namespace kcs::motion
