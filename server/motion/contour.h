// How far a motion is from a programmed path of straight segments.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "server/motion/phase.h"

namespace kcs::motion {

// Distance from a point to the segment between two points, mm.
double distance_to_segment(const Vector& point, const Vector& from, const Vector& to);

// Finds the largest contour error of phases, one after the other.
class ContourGauge {
 public:
  // points: the corners of the programmed path, segment i from points[i] to points[i + 1].
  explicit ContourGauge(std::span<const Vector> points);

  // The largest distance, mm, from the phase's curve to the nearest of its own segments (phase.segments), from above:
  // never less than the true one (but for rounding), and more by at most `resolution` (mm) if it is above
  // `ignore_below` (mm); what is smaller is only known to be smaller. Distance to a segment is a convex function, so
  // none of a Bézier curve is farther away than the farthest of its control points; halving the curve makes that bound
  // as sharp as is wanted.
  double largest_error(const Phase& phase, double resolution, double ignore_below) const;

 private:
  // Segments on one line are one piece: a curve that passes from one to the next is near to the line all the time.
  struct Piece {
    Vector from, to;
  };
  struct Search;

  std::vector<Piece> pieces_;
  std::vector<std::uint32_t> piece_of_;  // of each segment
};

}  // namespace kcs::motion
