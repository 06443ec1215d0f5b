#include "server/planning/corner_geometry.h"

#include <algorithm>
#include <cmath>

namespace kcs::planning {
namespace {

// With a limit on contour error alone, sharp corners could be cut without bound: the nearer the legs, the less the
// path notices that its tip is missing. So the corner point keeps the curve this many tolerances near…
// …and one tolerance near where the tool goes back on its own path (a drilled hole has a bottom).
constexpr double kDeepestCut = 4;

// A tolerance below this is none: coordinates cannot tell.
constexpr double kNoTolerance = 1e-12;  // mm

double reach_of(const CornerGeometry& corner, double tolerance, ToleranceKind kind) {
  if (kind == ToleranceKind::kCornerDistance || corner.half_cosine < kReversal) return tolerance;
  return tolerance * std::min(1 / corner.half_cosine, kDeepestCut);
}

// Unit tangents that differ by less are equal but for their rounding, unless an axis would notice: passing without
// smoothing changes its velocity at once, and that must be nothing for it.
bool is_straight(const CornerGeometry& corner, const AxisLimits& limits) {
  constexpr double kNothing = 1e-12, kNothingForAnAxis = 1e-10;
  if (2 * corner.half_sine >= kNothing) return false;
  const double speed = std::min(corner.in.feed, corner.out.feed);
  return speed <= kNothingForAnAxis * along(limits.velocity, corner.difference, limits.axes);
}

}  // namespace

CornerGeometry corner_geometry(const Leg& in, const Leg& out, const PlanOptions& options) {
  CornerGeometry corner{.in = in, .out = out};
  corner.difference = out.direction - in.direction;
  corner.sum = in.direction + out.direction;
  corner.half_sine = corner.difference.norm() / 2;
  corner.half_cosine = corner.sum.norm() / 2;
  corner.straight = is_straight(corner, options.limits);
  const double tolerance = std::min(in.tolerance, out.tolerance);
  corner.tolerance = tolerance * kToleranceMargin;
  corner.reach = reach_of(corner, tolerance, options.tolerance_kind);
  corner.cut = tolerance < kNoTolerance ? 0 : corner.reach * kToleranceMargin;
  return corner;
}

}  // namespace kcs::planning
