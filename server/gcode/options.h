// What a program does not say itself.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>

#include "server/planning/toolpath.h"

namespace kcs::gcode {

// The numbers must lie in the ranges of server/planning/options.h; the reader does not check them again.
struct Options {
  std::size_t axes = 3;                                    // 2 (X, Y) or 3 (X, Y, Z)
  planning::Vector start = planning::Vector::Zero();       // where the tool starts, mm
  double rapid = std::numeric_limits<double>::infinity();  // mm/s along the path; infinity: the axes' limits
  std::optional<double> feed;                              // mm/s; replaces every programmed feed and the rapid
  double tolerance = 0.01;                                 // mm, until the program says otherwise; 0 acts like G61
  std::size_t max_segments = 10'000'000;                   // of the whole path; 64 bytes each
  std::size_t max_chords = 1'000'000;                      // of one arc
  std::size_t max_names = 10'000;                          // of parameters, up to 100 bytes each
  std::size_t max_kept_bytes = 16'000'000;                 // of subroutines, and of the outermost loop
  // Lines that run in subroutines, conditions and loops, round after round; every 32 bytes of a line count as one.
  std::size_t max_blocks = 10'000'000;
};

}  // namespace kcs::gcode
