// What a stretch is made of: pieces of splines of time, whose steps may differ.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "server/planning/stretch_path.h"
#include "server/planning/time_spline.h"

namespace kcs::planning {

struct StretchPiece {
  motion::Phase phase;      // without segments; time and positions from where the stretch begins
  double from = 0, to = 0;  // the ways at its ends, mm
  // Of the path as it is known when it is found, that it may follow; see find_legs.
  std::size_t first_leg = 0, last_leg = 0;
};

// Appends the pieces of a spline that goes on from the pieces before, or begins.
void append_pieces(const TimeSpline& spline, std::vector<StretchPiece>& pieces);

// Finds the legs of these pieces, which follow each other.
void find_legs(const StretchPath& path, std::span<StretchPiece> pieces);

}  // namespace kcs::planning
