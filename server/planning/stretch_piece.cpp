#include "server/planning/stretch_piece.h"

#include <algorithm>

namespace kcs::planning {

void append_pieces(const TimeSpline& spline, std::vector<StretchPiece>& pieces) {
  const double start_time = pieces.empty() ? 0 : pieces.back().phase.end_time();
  for (std::size_t j = 0; j < spline.pieces(); ++j) {
    StretchPiece piece{.phase = spline.phase(j, Vector::Zero()),
                       .from = spline.ways[j],
                       .to = spline.ways[j + 3],
                       .begin = spline.ways[j + 1],
                       .end = spline.ways[j + 2]};
    piece.phase.start_time += start_time;
    if (!pieces.empty()) {  // a longer step reaches farther back, a shorter one less far ahead
      piece.from = std::max(piece.from, pieces.back().from);
      piece.to = std::max(piece.to, pieces.back().to);
    }
    pieces.push_back(piece);
  }
}

}  // namespace kcs::planning
