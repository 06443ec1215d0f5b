// Half of a corner: a motion along a leg and one across it, at the same time.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "server/motion/jlap.h"

namespace kcs::planning {

// A stretch of constant jerk along and across the leg.
struct HalfPhase {
  double duration = 0;  // s, > 0
  double along = 0;     // mm/s³
  double across = 0;    // mm/s³
};

// Where the tool is, from the corner point: along the leg, and to the inside of the corner.
struct HalfState {
  motion::LinearState along, across;

  HalfState after(const HalfPhase& phase) const;
};

// Two profiles that begin together, laid over each other. Ends with the one across; the one along is cut off there, or
// goes on without jerk.
class HalfCorner {
 public:
  HalfCorner(const motion::Jlap& along, const motion::Jlap& across);

  std::span<const HalfPhase> phases() const { return {phases_.data(), count_}; }

 private:
  std::array<HalfPhase, 6> phases_;  // each profile's end of a phase ends one here
  std::size_t count_ = 0;
};

}  // namespace kcs::planning
