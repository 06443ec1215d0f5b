// What a stretch is made of: pieces of splines of time, whose steps may differ.
#pragma once

#include <vector>

#include "server/planning/time_spline.h"

namespace kcs::planning {

struct StretchPiece {
  motion::Phase phase;        // without segments; time and positions from where the stretch begins
  double from = 0, to = 0;    // the ways between which it may be, mm; neither falls from piece to piece
  double begin = 0, end = 0;  // the ways at its ends, mm
};

// Appends the pieces of a spline that goes on from the pieces before, or begins.
void append_pieces(const TimeSpline& spline, std::vector<StretchPiece>& pieces);

}  // namespace kcs::planning
