// Plans a tool path: path and limits in, verified trajectory out.
#pragma once

#include "server/planning/options.h"
#include "server/planning/plan.h"
#include "server/planning/toolpath.h"

namespace kcs::planning {

// A pure function: the same input gives the same bytes, on any thread.
// Throws InvalidInput (invalid_input.h) if a number is not finite or outside its range (range.h), naming the segment,
// or if the path has no segment; Stopped (stopped.h) if options.stop asks for it; std::logic_error if the finished
// trajectory does not pass verification (a defect of kcs: the plan is not served).
Plan plan(const Toolpath& path, const PlanOptions& options);

}  // namespace kcs::planning
