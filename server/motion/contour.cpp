#include "server/motion/contour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "server/motion/straight_run.h"

namespace kcs::motion {
namespace {

// A cubic curve by its control points.
using Bezier = std::array<Vector, 4>;

// Deep enough to halve any phase down to the last bit of its duration's square: bounds converge quadratically.
constexpr int kMaxDepth = 40;

Bezier bezier_of(const Phase& phase) {
  const double t = phase.duration;
  const State end = phase.at(t);
  return {phase.start.position, phase.start.position + phase.start.velocity * (t / 3),
          end.position - end.velocity * (t / 3), end.position};
}

}  // namespace

double distance_to_segment(const Vector& point, const Vector& from, const Vector& to) {
  const Vector along = to - from;
  const double square = along.squaredNorm();
  if (square == 0) return (point - from).norm();
  const double share = std::clamp((point - from).dot(along) / square, 0.0, 1.0);
  // From the nearer end: a long segment does not lose digits.
  return share <= 0.5 ? (point - from - share * along).norm() : (point - to + (1 - share) * along).norm();
}

ContourGauge::ContourGauge(std::span<const Vector> points) {
  std::optional<StraightRun> run;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    if (run && run->extend(points[i + 1])) {
      pieces_.back().to = points[i + 1];
    } else {
      run.reset();
      if (points[i] != points[i + 1]) run.emplace(points[i], points[i + 1]);
      pieces_.push_back({points[i], points[i + 1]});
    }
    piece_of_.push_back(static_cast<std::uint32_t>(pieces_.size() - 1));
  }
}

struct ContourGauge::Search {
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

double ContourGauge::largest_error(const Phase& phase, double resolution, double ignore_below) const {
  const std::size_t first = piece_of_[phase.segments.first], last = piece_of_[phase.segments.last];
  Search search{std::span(pieces_).subspan(first, last - first + 1), resolution, ignore_below};
  const Bezier curve = bezier_of(phase);
  search.reached = std::max({search.reached, search.distance(curve[0]), search.distance(curve[3])});
  search.look_at(curve, 0);
  return search.bound;
}

}  // namespace kcs::motion
