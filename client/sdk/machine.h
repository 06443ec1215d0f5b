// A machine as the planner sees it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace kcs::client {

// A machine's axes and their limits, which hold for each axis by itself. Axes come in the order X, Y, Z; every array
// has one entry per axis. The server checks the ranges (proto/kcs/v1/planning.proto) and refuses what is outside them.
struct Machine {
  std::string name;                        // what people call it; only shown
  std::size_t axes = 0;                    // 2 (X, Y) or 3 (X, Y, Z)
  std::vector<double> velocity_mm_s;       // largest speed of each axis
  std::vector<double> acceleration_mm_s2;  // largest acceleration of each axis
  std::vector<double> jerk_mm_s3;          // largest jerk of each axis
  std::optional<double> rapid_mm_s;        // path speed of rapid moves; none: what the velocity limits allow
};

}  // namespace kcs::client
