// Reads a whole G-code program into a tool path that can be planned.
#pragma once

#include <istream>
#include <vector>

#include "server/gcode/notices.h"
#include "server/gcode/options.h"
#include "server/planning/toolpath.h"

namespace kcs::gcode {

struct Program {
  planning::Toolpath path;
  std::vector<Notice> notices;     // what its author should know
  double largest_chord_error = 0;  // distance between an arc and its chords, mm; 0 without arcs
};

// Reads `program` to its end. Throws planning::InvalidInput, with the place in the program, if it cannot be read or not
// be followed safely; std::ios_base::failure if the stream breaks off.
Program read_program(std::istream& program, const Options& options);

}  // namespace kcs::gcode
