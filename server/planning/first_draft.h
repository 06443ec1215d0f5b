// A slow motion to begin a search with.
#pragma once

#include "server/planning/smooth_motion.h"

namespace kcs::planning {

// From one place of the path to another: each corner at a speed at which it might be taken, and between them what half
// of the axes' acceleration allows. The first way is one step before `range.from`.
// Empty if it would have too many points to search with.
MotionDraft first_draft(const StretchPath& path, const motion::AxisLimits& limits, const MotionRange& range,
                        double step);

}  // namespace kcs::planning
