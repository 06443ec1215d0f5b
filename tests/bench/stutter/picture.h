// Draws speed against path.
#pragma once

#include <span>
#include <string>

#include "tests/bench/stutter/dips.h"

namespace kcs::bench {

// The whole program above, the surroundings of its deepest dip below, as a gnuplot script that writes the SVG file
// `picture`. Smooth curves are marked at the foot, dips deeper than `noticeable` (a share) by dots.
std::string picture_script(const std::string& title, const std::string& picture, std::span<const SpeedSample> samples,
                           std::span<const Stretch> stretches, std::span<const Dip> dips, double noticeable);

}  // namespace kcs::bench
