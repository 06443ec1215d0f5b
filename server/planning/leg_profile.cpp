#include "server/planning/leg_profile.h"

#include <algorithm>

#include "server/planning/search.h"

namespace kcs::planning {

LegEnd leg_end(const CornerMotion& corner, const Leg& leg) {
  return {corner.speed, corner.acceleration, corner.level(leg.jerk)};
}

motion::Ramp ramp_from(const Leg& leg, const LegEnd& end, double peak) {
  return motion::ramp_to_peak(end.speed, end.acceleration, peak, leg.acceleration, leg.jerk);
}

double needed_length(const Leg& leg, const CornerMotion& entry, const CornerMotion& exit) {
  const LegEnd from = leg_end(entry, leg), to = leg_end(exit, leg);
  const double peak = std::max(from.level, to.level);
  return entry.length + exit.length + ramp_from(leg, from, peak).distance + ramp_from(leg, to, peak).distance;
}

double peak_speed(const Leg& leg, const LegEnd& entry, const LegEnd& exit, double way) {
  const double least = std::max(entry.level, exit.level);
  if (least >= leg.feed) return least;
  return largest_fitting(least, leg.feed, kUnusedShare * way, [&](double peak) {
    return ramp_from(leg, entry, peak).distance + ramp_from(leg, exit, peak).distance - way;
  });
}

double leg_time(const Leg& leg, const CornerMotion& entry, const CornerMotion& exit) {
  const LegEnd from = leg_end(entry, leg), to = leg_end(exit, leg);
  const double way = leg.length - entry.length - exit.length;
  const double peak = peak_speed(leg, from, to, way);
  const motion::Ramp up = ramp_from(leg, from, peak), down = ramp_from(leg, to, peak);
  return up.duration + down.duration + std::max(0.0, way - up.distance - down.distance) / peak;
}

}  // namespace kcs::planning
