#include "server/planning/corner_geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace kcs::planning {
namespace {

// A curve that just touches its tolerance must not be found outside by a rounding.
constexpr double kToleranceMargin = 1 - 1e-7;

// With a limit on contour error alone, sharp corners could be cut without bound: the nearer the legs, the less the
// path notices that its tip is missing. So the corner point keeps the curve this many tolerances near…
constexpr double kDeepestCut = 4;
// …and one tolerance near where the tool goes back on its own path (a drilled hole has a bottom).
constexpr double kReversal = 175 * std::numbers::pi / 180;

// Unit tangents that differ by less are equal but for their rounding.
constexpr double kStraight = 1e-12;

double deepest_cut(double tolerance, ToleranceKind kind, const CornerGeometry& corner) {
  if (kind == ToleranceKind::kCornerDistance || corner.angle > kReversal) return tolerance * kToleranceMargin;
  return tolerance * kToleranceMargin * std::min(1 / corner.half_cosine, kDeepestCut);
}

}  // namespace

bool CornerGeometry::straight() const { return 2 * half_sine < kStraight; }

CornerGeometry corner_geometry(const Leg& in, const Leg& out, ToleranceKind kind) {
  CornerGeometry corner{.in = in, .out = out};
  corner.difference = out.direction - in.direction;
  corner.sum = in.direction + out.direction;
  corner.half_sine = corner.difference.norm() / 2;
  corner.half_cosine = corner.sum.norm() / 2;
  corner.angle = 2 * std::atan2(corner.half_sine, corner.half_cosine);
  corner.cut = deepest_cut(std::min(in.tolerance, out.tolerance), kind, corner);
  return corner;
}

}  // namespace kcs::planning
