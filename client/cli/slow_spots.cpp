#include "client/cli/slow_spots.h"

#include <algorithm>

namespace kcs::cli {
namespace {

std::vector<SlowSpot> group_by_line(const std::vector<client::Corner>& corners) {
  std::vector<SlowSpot> spots;
  double worst = 0;
  for (const client::Corner& corner : corners) {
    const bool same_spot = !spots.empty() && corner.line != 0 && spots.back().line == corner.line;
    if (!same_spot) {
      spots.push_back({.line = corner.line, .point_mm = corner.point_mm, .lowest_speed_mm_s = corner.speed_mm_s});
      worst = corner.time_lost_s;
    }
    SlowSpot& spot = spots.back();
    if (corner.time_lost_s > worst) {
      worst = corner.time_lost_s;
      spot.point_mm = corner.point_mm;
    }
    ++spot.corners;
    spot.largest_angle_deg = std::max(spot.largest_angle_deg, corner.angle_deg);
    spot.lowest_speed_mm_s = std::min(spot.lowest_speed_mm_s, corner.speed_mm_s);
    spot.time_lost_s += corner.time_lost_s;
  }
  return spots;
}

}  // namespace

std::vector<SlowSpot> slowest_spots(const std::vector<client::Corner>& corners, std::size_t count) {
  std::vector<SlowSpot> spots = group_by_line(corners);
  std::erase_if(spots, [](const SlowSpot& spot) { return spot.time_lost_s <= 0; });
  std::stable_sort(spots.begin(), spots.end(),
                   [](const SlowSpot& a, const SlowSpot& b) { return a.time_lost_s > b.time_lost_s; });
  spots.resize(std::min(spots.size(), count));
  return spots;
}

}  // namespace kcs::cli
