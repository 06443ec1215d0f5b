#include "server/motion/contour.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kcs::motion {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The bound converges with the square of the halved length, but where the nearest piece changes only with the length
// itself: from 1e7 mm to 1e-17 mm it takes 80 halvings, of one branch.
constexpr int kMaxDepth = 80;

struct Search {
  std::span<const Piece> pieces;
  double resolution;
  double reached;    // a distance that the curve reaches, or that does not matter
  double bound = 0;  // none of the curve that was looked at is farther away

  double distance(const Vector& point) const {
    double nearest = kInfinity;
    for (const Piece& piece : pieces) nearest = std::min(nearest, piece.line.square_distance(point));
    return std::sqrt(nearest);
  }

  // The farthest that any of the curve is from the piece, from above, mm; infinity if that is `enough` or more.
  static double bound_of(const Curve& curve, const Piece& piece, double enough) {
    double farthest = 0;
    for (const Vector& point : curve.points) {
      farthest = std::max(farthest, piece.line.square_distance(point));
      if (!(farthest < enough * enough)) return kInfinity;
    }
    return std::sqrt(farthest);
  }

  // The same for the best piece, tried from `likely` on; the first one that will do is good enough.
  double bound_of(const Curve& curve, std::size_t likely) const {
    double best = kInfinity;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const std::size_t index = likely + i < pieces.size() ? likely + i : pieces.size() - 1 - i;
      best = std::min(best, bound_of(curve, pieces[index], best));
      if (best <= reached + resolution) break;
    }
    return best;
  }

  void look_at(const Curve& curve, std::size_t likely) {
    const double upper = bound_of(curve, pieces[likely], kInfinity);
    if (upper <= reached + resolution) {
      bound = std::max(bound, upper);
    } else {
      reached = std::max({reached, distance(curve.points.front()), distance(curve.points.back())});
      look_closer(curve, likely, 0);
    }
  }

  void look_closer(const Curve& curve, std::size_t likely, int depth) {
    const double upper = bound_of(curve, likely);
    if (upper <= reached + resolution || depth == kMaxDepth) {
      bound = std::max(bound, upper);
      return;
    }
    const auto [left, right] = curve.halves();
    reached = std::max(reached, distance(left.points.back()));
    look_closer(left, likely, depth + 1);
    look_closer(right, likely, depth + 1);
  }
};

bool comes_within(const Curve& curve, const Vector& point, double distance, int depth) {
  // As seen from the point, all of the curve may lie beyond a plane that is too far away.
  const Vector way = (curve.points.front() + curve.points.back()) / 2 - point;
  const double plane = distance * way.norm();
  const auto beyond = [&](const Vector& control) { return (control - point).dot(way) > plane; };
  if (std::all_of(curve.points.begin(), curve.points.end(), beyond)) return false;
  const auto [left, right] = curve.halves();
  if ((left.points.back() - point).squaredNorm() <= distance * distance) return true;
  constexpr int kHalvings = 30;
  return depth < kHalvings &&
         (comes_within(left, point, distance, depth + 1) || comes_within(right, point, distance, depth + 1));
}

}  // namespace

double largest_contour_error(const Phase& phase, std::span<const Piece> pieces, std::span<const double> mitres,
                             double resolution, double ignore_below) {
  Search search{pieces, resolution, ignore_below};
  State from = phase.start;
  double time = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const double until = i < mitres.size() ? mitres[i] : phase.duration;
    if (!(until > time)) continue;
    const State to = phase.at(until);
    search.look_at(Curve::between(from, to, until - time), i);
    from = to;
    time = until;
  }
  return search.bound;
}

bool comes_within(const Curve& curve, const Vector& point, double distance) {
  const double square = distance * distance;
  return (curve.points.front() - point).squaredNorm() <= square ||
         (curve.points.back() - point).squaredNorm() <= square || comes_within(curve, point, distance, 0);
}

}  // namespace kcs::motion
