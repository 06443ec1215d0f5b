// How far a motion is from a programmed path.
#pragma once

#include <span>

#include "server/motion/course.h"
#include "server/motion/phase.h"

namespace kcs::motion {

// Distance from a point to the segment between two points, mm.
double distance_to_segment(const Vector& point, const Vector& from, const Vector& to);

// The largest distance, mm, from the phase's curve to the nearest of `pieces`, from above: never less than the true one
// (but for rounding), and more by at most `resolution` (mm) if it is above `ignore_below` (mm); what is smaller is only
// known to be smaller.
// Distance to a segment is a convex function, so none of a Bézier curve is farther away than the farthest of its
// control points; halving the curve makes that bound as sharp as is wanted.
double largest_contour_error(const Phase& phase, std::span<const Piece> pieces, double resolution, double ignore_below);

// How near the phase's curve comes to a point, mm: at most a millionth too much where it has one nearest place.
double closest_approach(const Phase& phase, const Vector& point);

}  // namespace kcs::motion
