#include "tests/bench/path_follower.h"

#include <algorithm>

#include "server/motion/contour.h"

namespace kcs::bench {

PathFollower::PathFollower(const planning::Toolpath& path, double tolerance)
    : path_(path), tolerance_(tolerance), position_(path.start) {
  for (std::size_t i = 0; i < path.segments.size(); ++i) {
    starts_.push_back(starts_.back() + (path.segments[i].end - path.start_of(i)).norm());
  }
}

PathFollower::Place PathFollower::follow(const planning::Vector& position) {
  constexpr double kCutCorner = 20;  // tolerances of the path that a cut corner may leave out
  constexpr double kDetour = 3;      // the path may be so much longer than the tool's way
  const double end = place_.length + kDetour * (position - position_).norm() + kCutCorner * tolerance_;
  Place best = nearest_on(place_.segment, position);
  for (std::size_t i = place_.segment + 1; i < path_.segments.size() && starts_[i] < end; ++i) {
    const Place place = nearest_on(i, position);
    if (place.distance < best.distance - planning::kNoLength) best = place;
  }
  // While it rounds a sharp corner, the tool may be nearer to the side that it comes from.
  for (std::size_t i = best.segment + 1; i-- > 0 && starts_[i + 1] > best.length - kCutCorner * tolerance_;) {
    best.distance =
        std::min(best.distance, motion::distance_to_segment(position, path_.start_of(i), path_.segments[i].end));
  }
  position_ = position;
  return place_ = best;
}

PathFollower::Place PathFollower::nearest_on(std::size_t segment, const planning::Vector& position) const {
  const planning::Vector& start = path_.start_of(segment);
  const planning::Vector way = path_.segments[segment].end - start;
  const double length = way.norm();
  const double passed = std::clamp(place_.length - starts_[segment], 0.0, length);
  const double along = length > 0 ? std::clamp(way.dot(position - start) / length, passed, length) : 0;
  const planning::Vector foot = length > 0 ? start + along / length * way : start;
  return {segment, starts_[segment] + along, (position - foot).norm()};
}

}  // namespace kcs::bench
