#include "server/planning/corner_list.h"

namespace kcs::planning {

void CornerList::append(const Corner& corner) {
  std::uint32_t timing = 0;
  if (corner.boundary_acceleration != 0 || corner.duration != 0 || corner.dwell != 0) {
    timings_.push_back({corner.boundary_acceleration, corner.duration, corner.dwell});
    timing = static_cast<std::uint32_t>(timings_.size());
  }
  corners_.push_back({corner.point, corner.angle, corner.speed, corner.corner_distance, corner.contour_error,
                      corner.time_lost, static_cast<std::uint32_t>(corner.segment), corner.line, timing,
                      corner.strategy});
}

Corner CornerList::operator[](std::size_t i) const {
  const Packed& packed = corners_[i];
  const Timing timing = packed.timing == 0 ? Timing{} : timings_[packed.timing - 1];
  return {.segment = packed.segment,
          .line = packed.line,
          .point = packed.point,
          .angle = packed.angle,
          .strategy = packed.strategy,
          .speed = packed.speed,
          .boundary_acceleration = timing.boundary_acceleration,
          .duration = timing.duration,
          .dwell = timing.dwell,
          .corner_distance = packed.corner_distance,
          .contour_error = packed.contour_error,
          .time_lost = packed.time_lost};
}

}  // namespace kcs::planning
