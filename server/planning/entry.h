// How the tool comes onto a part of a path from what is settled already.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "server/planning/corner_motion.h"
#include "server/planning/penalized_fit.h"
#include "server/planning/stretch_piece.h"
#include "server/planning/time_spline.h"

namespace kcs::planning {

// A stretch that has begun in the part before, where the corner at the end of the part's first leg has no record yet;
// or that begins with the path, in motion.
struct BegunStretch {
  // What is settled of it, from before the middle of the part's first leg on; one piece at least, or none if the path
  // begins with it. Ways count from the start of that leg, positions are where they are on the machine.
  std::vector<StretchPiece> settled;
  TimeSpline last;  // the last three points of that, or those of the motion with which the path begins
  // Where the search may begin: what was found beyond it, from these three points on, in the same steps; or nothing.
  std::vector<double> ways;
  FitWeights weights;
  std::size_t joint = 0;  // of the part: the next one that the tool passes
};

struct Entry {
  double taken = 0;     // of the first leg, by what came before, mm
  CornerMotion motion;  // out of the corner before, or along the leg; none: from rest
  double need = 0;      // what the corner before needs of the first leg, mm, so that the tool may be at the feed beyond
  bool rests = true;    // the tool rests where the part begins
  std::optional<BegunStretch> begun;  // in its middle; nothing else counts then
  // How a stretch would begin at once, if the path begins in motion. As all else says, a leg could.
  std::optional<BegunStretch> in_motion;
};

}  // namespace kcs::planning
