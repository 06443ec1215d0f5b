// What a motion along a path has to keep to, for the fit that makes it the quickest.
#pragma once

#include <span>

#include "server/motion/limits.h"
#include "server/planning/quickest_fit.h"
#include "server/planning/stretch_path.h"
#include "server/planning/time_spline.h"

namespace kcs::planning {

// Begins the fit with the points of the spline and bounds them: by the limits that it is near to, and by the legs
// and corners that it follows now, each when it follows it. A leg is convex, and so is what is near to it: the tool
// stays within a share of the tolerance. Where it is nearest to a corner, it stays within that share of its reach. The
// shares are those of the points of the spline.
void bound_motion(const StretchPath& path, const motion::AxisLimits& limits, const TimeSpline& spline,
                  std::span<const double> shares_of_tolerance, QuickestFit& fit);

}  // namespace kcs::planning
