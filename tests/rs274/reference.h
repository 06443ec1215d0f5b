// What LinuxCNC makes of a G-code program: an independent reading of it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "server/planning/toolpath.h"

namespace kcs::test {

// A straight move or an arc, in machine coordinates, mm.
struct Move {
  std::uint32_t line = 0;  // of the program
  planning::Vector end = planning::Vector::Zero();
  int turns = 0;  // 0: straight; > 0 counterclockwise, seen against the axis `normal`
  planning::Vector centre = planning::Vector::Zero();
  int normal = 2;  // 0 is X
};

struct Reference {
  std::vector<Move> moves;
  std::string obstacle;  // why the moves are not those of three milling axes alone; empty if they are
};

// Why there is no LinuxCNC to ask; empty if there is.
std::string why_no_reference();

// Has LinuxCNC read the program in `file`. Throws std::runtime_error if its interpreter does not come back.
Reference reference_of(const std::string& file);

// The G-code programs that come with LinuxCNC's package.
std::vector<std::string> programs_of_linuxcnc();

}  // namespace kcs::test
