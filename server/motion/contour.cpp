#include "server/motion/contour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace kcs::motion {
namespace {

// A cubic curve by its control points.
using Bezier = std::array<Vector, 4>;

// The bound converges with the square of the halved length, but where the nearest piece changes only with the length
// itself: from 1e7 mm to 1e-17 mm it takes 80 halvings, of one branch.
constexpr int kMaxDepth = 80;

Bezier bezier_of(const Phase& phase) {
  const double t = phase.duration;
  const State end = phase.at(t);
  return {phase.start.position, phase.start.position + phase.start.velocity * (t / 3),
          end.position - end.velocity * (t / 3), end.position};
}

struct Search {
  std::span<const Piece> pieces;
  double resolution;
  double reached;    // a distance that the curve reaches, or that does not matter
  double bound = 0;  // none of the curve that was looked at is farther away

  double distance(const Vector& point) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Piece& piece : pieces) nearest = std::min(nearest, distance_to_segment(point, piece.from, piece.to));
    return nearest;
  }

  // All of the curve is this near to one and the same piece.
  double bound_of(const Bezier& curve) const {
    double best = std::numeric_limits<double>::infinity();
    for (const Piece& piece : pieces) {
      double farthest = 0;
      for (const Vector& control : curve) {
        farthest = std::max(farthest, distance_to_segment(control, piece.from, piece.to));
      }
      best = std::min(best, farthest);
    }
    return best;
  }

  void look_at(const Bezier& curve, int depth) {
    const double upper = bound_of(curve);
    if (upper <= reached + resolution || depth == kMaxDepth) {
      bound = std::max(bound, upper);
      return;
    }
    const Vector ab = (curve[0] + curve[1]) / 2, bc = (curve[1] + curve[2]) / 2, cd = (curve[2] + curve[3]) / 2;
    const Vector abc = (ab + bc) / 2, bcd = (bc + cd) / 2;
    const Vector middle = (abc + bcd) / 2;
    reached = std::max(reached, distance(middle));
    look_at({curve[0], ab, abc, middle}, depth + 1);
    look_at({middle, bcd, cd, curve[3]}, depth + 1);
  }
};

}  // namespace

double distance_to_segment(const Vector& point, const Vector& from, const Vector& to) {
  const Vector along = to - from;
  const double square = along.squaredNorm();
  if (square == 0) return (point - from).norm();
  const double share = std::clamp((point - from).dot(along) / square, 0.0, 1.0);
  // From the nearer end: a long segment does not lose digits.
  return share <= 0.5 ? (point - from - share * along).norm() : (point - to + (1 - share) * along).norm();
}

double largest_contour_error(const Phase& phase, std::span<const Piece> pieces, double resolution,
                             double ignore_below) {
  Search search{pieces, resolution, ignore_below};
  const Bezier curve = bezier_of(phase);
  search.reached = std::max({search.reached, search.distance(curve[0]), search.distance(curve[3])});
  search.look_at(curve, 0);
  return search.bound;
}

double closest_approach(const Phase& phase, const Vector& point) {
  const auto distance = [&](double time) { return (phase.at(time).position - point).norm(); };
  constexpr int kSamples = 16;
  const double step = phase.duration / kSamples;
  int nearest = 0;
  for (int i = 1; i <= kSamples; ++i) {
    if (distance(i * step) < distance(nearest * step)) nearest = i;
  }
  double low = std::max(0, nearest - 1) * step, high = std::min(kSamples, nearest + 1) * step;
  double found = distance(nearest * step);
  for (int i = 0; i < 40; ++i) {  // each step keeps two thirds
    const double left = low + (high - low) / 3, right = high - (high - low) / 3;
    const double at_left = distance(left), at_right = distance(right);
    found = std::min({found, at_left, at_right});
    (at_left < at_right ? high : low) = at_left < at_right ? right : left;
  }
  return found;
}

}  // namespace kcs::motion
