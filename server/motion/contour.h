// How far a motion is from a programmed path, and how near it comes to a point.
#pragma once

#include <span>

#include "server/motion/course.h"
#include "server/motion/curve.h"
#include "server/motion/phase.h"

namespace kcs::motion {

// The largest distance, mm, from the phase's curve to the nearest of `pieces`, from above: never less than the true one
// (but for rounding), and more by at most `resolution` (mm) if it is above `ignore_below` (mm); what is smaller is only
// known to be smaller.
// `mitres`: when the phase passes from each piece to the next (mitres.h). They make it fast, not true: between them,
// the curve is mostly near to one piece. Distance to a piece is a convex function, so no part of a curve is farther
// away than the farthest of its Bézier points; halving the curve makes that bound as sharp as is wanted.
double largest_contour_error(const Phase& phase, std::span<const Piece> pieces, std::span<const double> mitres,
                             double resolution, double ignore_below);

// Whether the curve comes as near as `distance` (mm) to a point. What only a billionth of the curve does goes unseen.
bool comes_within(const Curve& curve, const Vector& point, double distance);

}  // namespace kcs::motion
