#include "server/planning/stretch_corners.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "server/planning/corner_geometry.h"
#include "server/planning/stopped.h"

namespace kcs::planning {
namespace {

// A stretch stays a little below the feed; from this share on it is at the feed.
constexpr double kAtFeed = 0.99;

// Samples of a piece, and steps from the best one to the nearest place.
constexpr int kSamples = 4, kSteps = 5;

// Follows a stretch along its path.
class Walk {
 public:
  explicit Walk(std::span<const StretchPiece> pieces) : pieces_(pieces) {}

  // When the motion is at this way; ways must not fall from call to call.
  double time_at(double way) {
    while (piece_ + 1 < pieces_.size() && pieces_[piece_].to < way) ++piece_;
    const StretchPiece& piece = pieces_[piece_];
    const double length = piece.to - piece.from;
    const double share = length > 0 ? std::clamp((way - piece.from) / length, 0.0, 1.0) : 0;
    return piece.phase.start_time + share * piece.phase.duration;
  }

 private:
  std::span<const StretchPiece> pieces_;
  std::size_t piece_ = 0;
};

// The state in which the motion is nearest to a point: the best of a few samples, and then where the velocity is square
// to the way to the point, by Newton's method.
motion::State nearest_in(const motion::Phase& phase, const Vector& point) {
  const double step = phase.duration / kSamples;
  motion::State best = phase.start;
  double time = 0, least = (best.position - point).squaredNorm();
  const auto try_at = [&](double tried) {
    const motion::State state = phase.at(tried);
    const double distance = (state.position - point).squaredNorm();
    if (distance >= least) return false;
    best = state;
    time = tried;
    least = distance;
    return true;
  };
  for (int i = 1; i <= kSamples; ++i) try_at(step * i);
  for (int i = 0; i < kSteps; ++i) {
    const Vector away = best.position - point;
    const double slope = away.dot(best.velocity);
    const double bend = best.velocity.squaredNorm() + away.dot(best.acceleration);
    if (!(bend > 0) || !try_at(std::clamp(time - slope / bend, 0.0, phase.duration))) break;
  }
  return best;
}

struct Nearest {
  motion::State state;
  double contour_error = 0;  // mm
};

// Looks at the pieces that pass from one leg to another. Legs must not fall from call to call.
class Passing {
 public:
  // settled: how many of its pieces are.
  Passing(const Stretch& stretch, std::size_t settled)
      : path_(stretch.path()), pieces_(stretch.pieces().first(settled)) {}

  // Where the motion is nearest to the end of a leg.
  Nearest to_end_of(std::size_t leg) {
    const Vector& point = path_.corners()[leg + 1];
    while (first_ + 1 < pieces_.size() && pieces_[first_].last_leg <= leg) ++first_;
    Nearest best;
    double least = std::numeric_limits<double>::infinity();
    std::size_t nearest = first_;
    for (std::size_t j = first_; j < pieces_.size() && pieces_[j].first_leg <= leg; ++j) {
      const double distance = std::min((at_knot(j) - point).squaredNorm(), (at_knot(j + 1) - point).squaredNorm());
      if (distance >= least) continue;
      least = distance;
      nearest = j;
    }
    least = std::numeric_limits<double>::infinity();
    // A knot may be the nearest of all, but a place in the piece on either side of it nearer still.
    for (std::size_t j = std::max(first_, nearest > 0 ? nearest - 1 : 0); j <= nearest + 1 && j < pieces_.size(); ++j) {
      if (pieces_[j].first_leg > leg) break;
      const motion::State state = nearest_in(pieces_[j].phase, point);
      const double distance = (state.position - point).squaredNorm();
      if (distance >= least) continue;
      least = distance;
      best = {state, error(state.position, j)};
    }
    return best;
  }

 private:
  // From the legs that the piece follows, mm.
  double error(const Vector& position, std::size_t piece) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t leg = pieces_[piece].first_leg; leg <= pieces_[piece].last_leg; ++leg) {
      least = std::min(least, path_.pieces()[leg].line.square_distance(position));
    }
    return std::sqrt(least);
  }

  // Where piece j begins, or the last one ends.
  Vector at_knot(std::size_t j) const {
    if (j < pieces_.size()) return pieces_[j].phase.start.position;
    return pieces_[j - 1].phase.at(pieces_[j - 1].phase.duration).position;
  }

  const StretchPath& path_;
  std::span<const StretchPiece> pieces_;
  std::size_t first_ = 0;  // piece
};

double time_at_feed(const Stretch& stretch, std::size_t from, std::size_t to) {
  double time = 0;
  for (const StretchPiece& piece : stretch.pieces().subspan(from, to - from)) {
    const motion::Phase& phase = piece.phase;
    const double feed = stretch.path().feed_between(piece.from, piece.to);
    if (phase.at(phase.duration / 2).velocity.norm() >= kAtFeed * feed) time += phase.duration;
  }
  return time;
}

double middle_of(const StretchPath& path, std::size_t leg) { return (path.way(leg) + path.way(leg + 1)) / 2; }

}  // namespace

std::size_t first_unreported(const Stretch& stretch, std::size_t pieces) {
  const StretchPath& path = stretch.path();
  const std::size_t corners = path.legs().size() - 1;
  if (pieces == 0) return 0;
  if (pieces == stretch.pieces().size()) return corners;
  const std::size_t followed = stretch.pieces()[pieces].first_leg;
  std::size_t corner = 0;
  while (corner < followed && middle_of(path, corner + 1) <= stretch.pieces()[pieces - 1].to) ++corner;
  return corner;
}

StretchTimes add_corners(const Stretch& stretch, std::size_t from, std::size_t to, const std::vector<Joint>& joints,
                         std::size_t first_leg, const PlanOptions& options, std::vector<Corner>& corners) {
  const StretchPath& path = stretch.path();
  const auto legs = path.legs();
  const auto at_feed = [&](std::size_t leg) { return (path.way(leg + 1) - path.way(leg)) / legs[leg].feed; };
  const std::size_t first = first_unreported(stretch, from), end = first_unreported(stretch, to);
  Walk walk(stretch.pieces());
  Passing passing(stretch, to);
  double before = walk.time_at(middle_of(path, first));
  StretchTimes result{.at_feed = time_at_feed(stretch, from == 0 ? stretch.first_piece() : from, to)};
  if (from == 0 && stretch.first_piece() == 0) result.entry_lost = before - at_feed(0) / 2;
  for (std::size_t i = first; i < end; ++i) {
    throw_if_stopped(options.stop);
    const CornerGeometry geometry = corner_geometry(legs[i], legs[i + 1], options);
    const Vector& point = path.corners()[i + 1];
    const auto [at, contour_error] = passing.to_end_of(i);
    const double after = walk.time_at(middle_of(path, i + 1));
    corners.push_back({.segment = legs[i].segments.last,
                       .line = joints[first_leg + i].line,
                       .point = legs[i].end,
                       .angle = geometry.angle(),
                       .strategy = CornerStrategy::kOverlapping,
                       .speed = at.velocity.norm(),
                       .corner_distance = (at.position - point).norm(),
                       .contour_error = contour_error,
                       .time_lost = after - before - at_feed(i) / 2 - at_feed(i + 1) / 2});
    before = after;
  }
  if (end + 1 == legs.size()) {
    result.exit_lost = stretch.duration() - before - at_feed(legs.size() - 1) / 2;
  }
  return result;
}

}  // namespace kcs::planning
