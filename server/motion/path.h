// The programmed path, to tell how far along it the tool is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

#include "server/motion/phase.h"

namespace kcs::motion {

// A place on a path.
struct Place {
  double way = 0;             // from the start of the path to there, along it, mm
  std::uint32_t segment = 0;  // that it lies on, counted from 0
};

// The ends of a path's straight segments and the way to each: 32 bytes a segment. Those that are no longer needed can
// be forgotten.
class Path {
 public:
  explicit Path(const Vector& start = Vector::Zero()) : points_{{start, 0}} {}

  // Goes on with a segment to this point, mm.
  void add(const Vector& end) { points_.push_back({end, points_.back().way + (end - points_.back().position).norm()}); }

  std::uint32_t segments() const { return first_ + static_cast<std::uint32_t>(points_.size()) - 1; }
  double length() const { return points_.back().way; }  // mm
  Place end() const { return {length(), segments() > 0 ? segments() - 1 : 0}; }

  // Where a segment starts, and the way to there, mm; both of segments(): where the path ends.
  const Vector& start_of(std::uint32_t segment) const { return points_[segment - first_].position; }
  double way_to(std::uint32_t segment) const { return points_[segment - first_].way; }

  // Forgets the segments before `segment` ≤ segments().
  void forget_before(std::uint32_t segment) {
    for (; first_ < segment; ++first_) points_.pop_front();
  }

  std::size_t bytes() const { return points_.size() * sizeof(Point); }  // of memory

 private:
  struct Point {
    Vector position;  // mm
    double way;       // mm
  };

  std::uint32_t first_ = 0;  // segment that is not forgotten
  std::deque<Point> points_;
};

}  // namespace kcs::motion
