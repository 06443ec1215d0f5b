// How near to each other the corners of a path are, measured by the points of a motion along it.
#pragma once

#include <cstddef>

#include "server/planning/stretch_path.h"

namespace kcs::planning {

// Sharp corners follow each other within a few of so many points between two ways, mm.
bool is_crowded(const StretchPath& path, double from, double to, std::size_t points);

// Legs follow each other within a few of so many points between two ways, mm, their corners are not crowded, and the
// points are many.
bool is_dense(const StretchPath& path, double from, double to, std::size_t points);

// Legs are so long that the motion is on lines most of the time, and the points are many.
bool is_sparse(const StretchPath& path, double from, double to, std::size_t points);

}  // namespace kcs::planning
