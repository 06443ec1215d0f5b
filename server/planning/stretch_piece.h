// What a stretch is made of: pieces of splines of time, whose steps may differ.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "server/planning/time_spline.h"

namespace kcs::planning {

struct StretchPiece {
  motion::Phase phase;        // without segments; time and positions from where the stretch begins
  double from = 0, to = 0;    // the ways between which it may be, mm; neither falls from piece to piece
  double begin = 0, end = 0;  // the ways at its ends, mm
};

// Appends the pieces of a spline that goes on from the pieces before, or begins.
inline void append_pieces(const TimeSpline& spline, std::vector<StretchPiece>& pieces) {
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
