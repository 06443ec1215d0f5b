#include "server/motion/course.h"

#include <optional>

#include "server/motion/straight_run.h"

namespace kcs::motion {

double Piece::rounding() const { return position_rounding(from) + position_rounding(to); }

Course::Course(const Reference& reference) {
  std::optional<StraightRun> run;
  for (std::size_t i = 0; i < reference.feed.size(); ++i) {
    const Vector &from = reference.points[i], &to = reference.points[i + 1];
    const Piece piece{from, to, reference.feed[i], reference.tolerance[i], reference.reach[i], reference.rest[i]};
    const bool joins = run && pieces_.back().rest < 0 && pieces_.back().feed == piece.feed &&
                       pieces_.back().tolerance == piece.tolerance && run->extend(to);
    if (joins) {
      pieces_.back().to = to;
      pieces_.back().reach = piece.reach;
      pieces_.back().rest = piece.rest;
    } else {
      run.reset();
      if (from != to) run.emplace(from, to);
      pieces_.push_back(piece);
    }
    piece_of_.push_back(static_cast<std::uint32_t>(pieces_.size() - 1));
  }
}

}  // namespace kcs::motion
