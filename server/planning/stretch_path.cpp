#include "server/planning/stretch_path.h"

#include <algorithm>
#include <cmath>

#include "server/planning/corner_geometry.h"
#include "server/planning/sharp_turns.h"
#include "server/planning/stopped.h"

namespace kcs::planning {
namespace {

// At a corner, the motion may be on the next leg this many tolerances before or after the place where the path is.
constexpr double kAround = 6;

// Another place may be nearer although the path leads away at first: it is looked for so many tolerances away.
constexpr double kDetour = 3;

// The square of the tangent of half the angle between two directions; +infinity if they are opposite.
double half_tangent_square(const Vector& from, const Vector& to) {
  return (to - from).squaredNorm() / (from + to).squaredNorm();
}

}  // namespace

StretchPath::StretchPath(const LegPath& path, const LegRange& range, const PlanOptions& options)
    : legs_(std::span(path.legs).subspan(range.first, range.last - range.first + 1)),
      skipped_(range.skipped),
      ends_{0},
      corners_{range.skipped * legs_.front().direction},
      tolerance_(legs_.front().tolerance) {
  for (std::size_t i = 0; i < legs_.size(); ++i) {
    ends_.push_back(ends_.back() + legs_[i].length - (i == 0 ? range.skipped : 0));
    corners_.push_back(legs_[i].end - origin());
    pieces_.emplace_back(legs_[i].start - origin(), motion::PathSegment{.end = legs_[i].end - origin()}, 0);
    if (feeds_.empty() || feeds_.back().feed != legs_[i].feed) feeds_.push_back({.end = 0, .feed = legs_[i].feed});
    feeds_.back().end = ends_.back();
    tolerance_ = std::min(tolerance_, legs_[i].tolerance);
    if (i + 1 < legs_.size()) reaches_.push_back(corner_geometry(legs_[i], legs_[i + 1], options).reach);
  }
  ends_.back() -= range.left;
  corners_.back() -= range.left * legs_.back().direction;
  for (std::size_t i = 0; i < legs_.size(); ++i) {
    lines_.push_back({corners_[i], legs_[i].direction, ends_[i + 1] - ends_[i], 1 / legs_[i].tolerance});
  }
  find_turns(options.stop);
  find_what_may_be_missed(options.stop);
}

// Sharp corners, and what lies so near to one that the motion, which cuts it, leaves it out.
void StretchPath::find_what_may_be_missed(const std::stop_token& stop) {
  may_be_missed_.assign(reaches_.size(), false);
  for (std::size_t i = 0; i < reaches_.size(); ++i) {
    throw_if_stopped(stop);
    if (!is_sharp(legs_[i].direction, legs_[i + 1].direction)) continue;
    const double reach = reaches_[i];
    for (std::size_t k = i; k < reaches_.size() && ends_[k + 1] <= ends_[i + 1] + reach; ++k) may_be_missed_[k] = true;
    for (std::size_t k = i; k-- > 0 && ends_[k + 1] >= ends_[i + 1] - reach;) may_be_missed_[k] = true;
  }
}

void StretchPath::find_turns(const std::stop_token& stop) {
  const double detour = kDetour * tolerance_;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    throw_if_stopped(stop);
    for (std::size_t k = i + 1; k < lines_.size() && ends_[k] <= ends_[i + 1] + detour; ++k) {
      lines_[i].turn_after =
          std::max(lines_[i].turn_after, half_tangent_square(lines_[i].direction, lines_[k].direction));
    }
    for (std::size_t k = i; k-- > 0 && ends_[k + 1] >= ends_[i] - detour;) {
      lines_[i].turn_before =
          std::max(lines_[i].turn_before, half_tangent_square(lines_[k].direction, lines_[i].direction));
    }
  }
}

std::size_t StretchPath::leg_at(double way) const {
  return static_cast<std::size_t>(std::lower_bound(ends_.begin() + 1, ends_.end() - 1, way) - ends_.begin()) - 1;
}

std::size_t StretchPath::leg_at(double way, std::size_t near) const {
  while (near > 0 && way < ends_[near]) --near;
  while (near + 1 < legs_.size() && way > ends_[near + 1]) ++near;
  return near;
}

double StretchPath::square_distance(const Vector& point, std::size_t leg, double& along) const {
  const Line& line = lines_[leg];
  const Vector from = point - line.start;
  along = std::min(std::max(from.dot(line.direction), 0.0), line.length);
  return (from - along * line.direction).squaredNorm();
}

Projection StretchPath::project(const Vector& point, std::size_t near) const {
  double along = 0;
  double least = square_distance(point, near, along);
  Projection best{near, ends_[near] + along, 0};
  // On and on while it comes nearer, and past small detours.
  const auto look = [&](std::size_t leg) {
    const double square = square_distance(point, leg, along);
    const bool nearer = square <= least;
    if (nearer) {
      least = square;
      best.leg = leg;
      best.way = ends_[leg] + along;
    }
    return nearer;
  };
  // A point is nearer to a leg than to all that follow if it is on this side of the planes that halve the angles.
  const Line& line = lines_[near];
  const double before = along, after = line.length - along, first = least;
  const double detour = kDetour * tolerance_;
  if (!(after * after > line.turn_after * first)) {
    for (std::size_t leg = near; leg + 1 < legs_.size();) {
      const bool nearer = look(++leg);
      if (!nearer && ends_[leg + 1] > best.way + detour) break;
    }
  }
  if (!(before * before > line.turn_before * first)) {
    for (std::size_t leg = near; leg > 0;) {
      const bool nearer = look(--leg);
      if (!nearer && ends_[leg] < best.way - detour) break;
    }
  }
  best.distance = std::sqrt(least);
  return best;
}

std::pair<std::size_t, std::size_t> StretchPath::legs_between(double from, double to, std::size_t near) const {
  const auto go_to = [&](double way) {  // where two legs meet, the second
    while (near > 0 && ends_[near] > way) --near;
    while (near + 1 < legs_.size() && ends_[near + 1] <= way) ++near;
    return near;
  };
  const std::size_t first = go_to(from - kAround * tolerance_);
  return {first, go_to(to + kAround * tolerance_)};
}

double StretchPath::feed_between(double from, double to) const {
  const double begin = from - kAround * tolerance_, end = to + kAround * tolerance_;
  auto run = std::upper_bound(feeds_.begin(), feeds_.end() - 1, begin,
                              [](double way, const FeedRun& it) { return way < it.end; });
  double least = run->feed;
  for (; run + 1 != feeds_.end() && run->end <= end; ++run) least = std::min(least, (run + 1)->feed);
  return least;
}

}  // namespace kcs::planning
