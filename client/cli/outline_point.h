// A point of a path that is to be drawn.
#pragma once

namespace kcs::cli {

struct OutlinePoint {
  double x = 0;      // mm
  double y = 0;      // mm
  double speed = 0;  // mm/s
};

}  // namespace kcs::cli
