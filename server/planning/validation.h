// Is there anything in a request that cannot be planned?
#pragma once

#include "server/planning/options.h"
#include "server/planning/toolpath.h"

namespace kcs::planning {

// A refused path names this many places at the most.
inline constexpr std::size_t kMaxViolations = 20;

// Each throws InvalidInput unless every number is finite and in its range. Fields are named "limits.jerk[1]" and
// "path, segment 17, feed".
void validate(const PlanOptions& options);
void validate(const PathEnds& ends, std::size_t axes);
void validate(const Segment& segment, std::size_t index, std::size_t axes);

// All of it; and the path has a segment.
void validate(const Toolpath& path, const PlanOptions& options);

}  // namespace kcs::planning
