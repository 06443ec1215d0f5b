// The programmed path, to tell how far along it the tool is, and at which line of the program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

#include "server/motion/phase.h"
#include "server/motion/program_lines.h"

namespace kcs::motion {

// A place on a path.
struct Place {
  double way = 0;             // from the start of the path to there, along it, mm
  std::uint32_t segment = 0;  // that it lies on, counted from 0
};

// The ends of a path's straight segments, the way to each and the line that it comes from: 32 bytes a segment, and
// what ProgramLines takes. Those that are no longer needed can be forgotten.
class Path {
 public:
  explicit Path(const Vector& start = Vector::Zero()) : points_{{start, 0}} {}

  // Goes on with a segment to this point, mm. line: of the program, from 1; 0: not known.
  void add(const Vector& end, std::uint32_t line = 0) {
    points_.push_back({end, points_.back().way + (end - points_.back().position).norm()});
    lines_.add(line);
  }

  std::uint32_t segments() const { return first_ + static_cast<std::uint32_t>(points_.size()) - 1; }
  double length() const { return points_.back().way; }  // mm
  Place end() const { return {length(), segments() > 0 ? segments() - 1 : 0}; }

  // Where a segment starts, and the way to there, mm; both of segments(): where the path ends.
  const Vector& start_of(std::uint32_t segment) const { return points_[segment - first_].position; }
  double way_to(std::uint32_t segment) const { return points_[segment - first_].way; }

  // The line of the program that a segment comes from; 0: not known, or there is no segment.
  std::uint32_t line_of(std::uint32_t segment) const { return lines_.of(segment); }

  // Forgets the segments before `segment` ≤ segments().
  void forget_before(std::uint32_t segment) {
    for (; first_ < segment; ++first_) points_.pop_front();
    lines_.forget_before(segment);
  }

  std::size_t bytes() const { return points_.size() * sizeof(Point) + lines_.bytes(); }  // of memory

 private:
  struct Point {
    Vector position;  // mm
    double way;       // mm
  };

  std::uint32_t first_ = 0;  // segment that is not forgotten
  std::deque<Point> points_;
  ProgramLines lines_;
};

}  // namespace kcs::motion
