#include "server/motion/course.h"

namespace kcs::motion {

Piece::Piece(const Vector& from, const PathSegment& segment, std::uint32_t index)
    : line(from, segment.end),
      feed(segment.feed),
      tolerance(segment.tolerance),
      reach(segment.reach),
      rest(segment.rest),
      rounding(position_rounding(from) + position_rounding(segment.end)),
      last_segment(index) {}

void Piece::extend(const PathSegment& segment, std::uint32_t index) { *this = Piece(line.from(), segment, index); }

void Course::add(const PathSegment& segment) {
  const std::uint32_t index = segments_++;
  const bool joins = run_ && window_.back().rest < 0 && window_.back().feed == segment.feed &&
                     window_.back().tolerance == segment.tolerance && run_->extend(segment.end);
  if (joins) {
    window_.back().extend(segment, index);
  } else {
    run_.reset();
    if (segment.end != end_) run_.emplace(end_, segment.end);
    window_.emplace_back(end_, segment, index);
  }
  end_ = segment.end;
}

std::uint32_t Course::settled_segments() const { return pieces() < 2 ? 0 : piece(pieces() - 2).last_segment + 1; }

SegmentRange Course::pieces_of(const SegmentRange& segments) const {
  std::uint32_t first = first_;
  while (piece(first).last_segment < segments.first) ++first;
  std::uint32_t last = first;
  while (piece(last).last_segment < segments.last) ++last;
  return {first, last};
}

void Course::forget_before(std::uint32_t index) {
  if (index <= first_) return;
  begin_ += index - first_;
  first_ = index;
  if (2 * begin_ < window_.size()) return;
  window_.erase(window_.begin(), window_.begin() + static_cast<std::ptrdiff_t>(begin_));
  begin_ = 0;
}

}  // namespace kcs::motion
