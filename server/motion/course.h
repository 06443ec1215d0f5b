// The programmed path as a trajectory is judged by it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "server/motion/phase.h"

namespace kcs::motion {

// What was asked for. Segment i goes from points[i] to points[i + 1]; the other arrays have one entry per segment.
struct Reference {
  std::span<const Vector> points;     // mm, one more than segments
  std::span<const double> feed;       // mm/s
  std::span<const double> tolerance;  // mm: the largest contour error of a phase that follows the segment
  std::span<const double> reach;      // mm: how near the motion must come to the segment's end point
  std::span<const double> rest;       // s: how long the tool must rest on the end point, exactly; negative: no rest
};

// Segments that lie on one line and agree, taken together: a curve that passes from one to the next is near to the
// line all the time.
struct Piece {
  Vector from = Vector::Zero(), to = Vector::Zero();  // mm
  double feed = 0;                                    // mm/s
  double tolerance = 0;                               // mm
  double reach = 0;                                   // mm, of the end
  double rest = -1;                                   // s, at the end

  // What cannot be told about a distance to the piece, because of its coordinates' rounding, mm.
  double rounding() const;
};

// The pieces of a path, in order. Linear in time and memory.
class Course {
 public:
  explicit Course(const Reference& reference);

  std::span<const Piece> pieces() const { return pieces_; }
  std::size_t segments() const { return piece_of_.size(); }

  // The pieces of a range of segments; last < segments().
  SegmentRange pieces_of(const SegmentRange& segments) const {
    return {piece_of_[segments.first], piece_of_[segments.last]};
  }
  std::span<const Piece> part(const SegmentRange& pieces) const {
    return std::span(pieces_).subspan(pieces.first, pieces.last - pieces.first + 1);
  }

 private:
  std::vector<Piece> pieces_;
  std::vector<std::uint32_t> piece_of_;  // of each segment
};

}  // namespace kcs::motion
