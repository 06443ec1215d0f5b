// The programs that are measured.
#pragma once

#include <string>

#include "server/gcode/options.h"
#include "server/planning/options.h"
#include "server/planning/toolpath.h"

namespace kcs::bench {

// The whole file. Throws std::runtime_error that names it if it cannot be read.
std::string text_of(const std::string& file);

// The tool path of a G-code program. Throws planning::InvalidInput where it cannot be read.
planning::Toolpath toolpath_of(const std::string& gcode, const gcode::Options& options);

// Axes that are alike: 500 mm/s and the given acceleration (mm/s²) and jerk (mm/s³).
planning::PlanOptions machine(double acceleration, double jerk);

}  // namespace kcs::bench
