// How firmly the points of a smooth motion are held, from round to round of its search.
#pragma once

#include "server/planning/motion_shares.h"
#include "server/planning/penalized_fit.h"

namespace kcs::planning {

// The greatest place weight. A place weight of w against a jerk weight of 1 holds a point about w^(-1/6) steps wide.
inline constexpr double kFirmest = 1e4;

// What presses on a limit or on the tolerance gets more weight, what does not gets less. hold_steps: the hold time of
// the search (smooth_motion.cpp), in steps; what is held for its speed, and no place at all, is held over more than a
// share of it.
void reweigh(const MotionShares& shares, const SearchMode& mode, double hold_steps, FitWeights& weights);

}  // namespace kcs::planning
