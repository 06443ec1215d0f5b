// The motion along one leg, between its two corners: up to a peak speed and down again, at most seven phases.
#pragma once

#include "server/motion/jlap.h"
#include "server/planning/corner_motion.h"
#include "server/planning/leg.h"

namespace kcs::planning {

// How the motion along a leg begins or, seen backwards, ends: at this speed, and accelerating (braking) already.
struct LegEnd {
  double speed = 0;         // mm/s
  double acceleration = 0;  // mm/s², ≥ 0
  double level = 0;         // mm/s: the least peak speed with which this end is possible
};

LegEnd leg_end(const CornerMotion& corner, const Leg& leg);

// From the end up to the peak speed, without acceleration there.
motion::Ramp ramp_from(const Leg& leg, const LegEnd& end, double peak);

// The length that the leg needs for these two corners at least, mm: both corner zones and the shortest motion between
// them. The leg is possible if that is at most its length.
double needed_length(const Leg& leg, const CornerMotion& entry, const CornerMotion& exit);

// Searches end when no more than this share of a length is left unused.
inline constexpr double kUnusedShare = 1e-12;

// The fastest peak speed, up to the leg's feed, for which both ramps fit into `way` (mm) between the corner zones.
double peak_speed(const Leg& leg, const LegEnd& entry, const LegEnd& exit, double way);

// Time between the corner zones, s.
double leg_time(const Leg& leg, const CornerMotion& entry, const CornerMotion& exit);

}  // namespace kcs::planning
