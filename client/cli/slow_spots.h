// Where a program loses time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "client/sdk/plan.h"

namespace kcs::cli {

// The corners that one line of the program makes one after the other: a single one, or all those of an arc's chords.
struct SlowSpot {
  std::uint32_t line = 0;        // 0 if not known
  std::vector<double> point_mm;  // the corner that costs most
  std::size_t corners = 0;
  double largest_angle_deg = 0;
  double lowest_speed_mm_s = 0;
  double time_lost_s = 0;  // by all its corners
};

// The `count` spots that lose most time, the worst first; spots that lose none are left out.
std::vector<SlowSpot> slowest_spots(const std::vector<client::Corner>& corners, std::size_t count);

}  // namespace kcs::cli
