// The lengths that words state.
#pragma once

#include "server/gcode/coordinates.h"
#include "server/gcode/words.h"

namespace kcs::gcode {

inline constexpr Letters kPolar = letters("@^");
inline constexpr Letters kAxes = letters("XYZ") | kPolar;

// The letter of an axis: 0 is X.
constexpr char axis_letter(int axis) { return static_cast<char>('X' + axis); }

// What a word that the block has states, mm; `unit` is the program's unit of length, mm. Refuses what no machine can
// reach.
double length_of(const Words& words, char letter, double unit);

// What the block's words X, Y and Z state, mm.
Stated stated_by(const Words& words, double unit);

// Where the block's move leads that begins at `from` (the program's coordinates, mm): what it states of X, Y and Z, and
// of the radius @ and the angle ^ (degrees) about the program's zero in X and Y. Where `incremental`, all of them are
// added to where the tool is, and the result is what is added to X, Y and Z.
Stated stated_move(const Words& words, double unit, bool incremental, const Vector& from);

}  // namespace kcs::gcode
