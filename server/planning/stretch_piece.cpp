#include "server/planning/stretch_piece.h"

#include <tuple>

namespace kcs::planning {

void append_pieces(const TimeSpline& spline, std::vector<StretchPiece>& pieces) {
  const double start_time = pieces.empty() ? 0 : pieces.back().phase.end_time();
  for (std::size_t j = 0; j < spline.pieces(); ++j) {
    StretchPiece piece{.phase = spline.phase(j, Vector::Zero()), .from = spline.ways[j + 1], .to = spline.ways[j + 2]};
    piece.phase.start_time += start_time;
    pieces.push_back(piece);
  }
}

void find_legs(const StretchPath& path, std::span<StretchPiece> pieces) {
  std::size_t near = 0;
  for (StretchPiece& piece : pieces) {
    std::tie(piece.first_leg, piece.last_leg) = path.legs_between(piece.from, piece.to, near);
    near = piece.first_leg;
  }
}

}  // namespace kcs::planning
