// Where the tool slows down and speeds up again although the curve does not ask for it.
#pragma once

#include <span>
#include <vector>

#include "tests/bench/stutter/smooth_stretches.h"
#include "tests/bench/stutter/speed_samples.h"

namespace kcs::bench {

struct Dip {
  SpeedSample at;    // where it is deepest
  double depth = 0;  // 1 − speed / the speed that could have been kept
};

// All dips, even of rounding, one for each place where the tool slows down inside a smooth stretch. The speed that
// could have been kept is the least of three: the fastest within ten segments before, within ten after, and what the
// curve allows there.
std::vector<Dip> find_dips(std::span<const SpeedSample> samples, std::span<const Stretch> stretches);

}  // namespace kcs::bench
