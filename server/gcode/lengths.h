// The lengths that words state.
#pragma once

#include "server/gcode/coordinates.h"
#include "server/gcode/words.h"

namespace kcs::gcode {

inline constexpr Letters kAxes = letters("XYZ");

// The letter of an axis: 0 is X.
constexpr char axis_letter(int axis) { return static_cast<char>('X' + axis); }

// What a word that the block has states, mm; `unit` is the program's unit of length, mm. Refuses what no machine can
// reach.
double length_of(const Words& words, char letter, double unit);

// What the block's words X, Y and Z state, mm.
Stated stated_by(const Words& words, double unit);

}  // namespace kcs::gcode
