// Whether every word of a block has a use.
#pragma once

#include "server/gcode/codes.h"
#include "server/gcode/modes.h"
#include "server/gcode/words.h"

namespace kcs::gcode {

// Refuses words for an axis that the machine does not have. axes: 2 (X, Y) or 3 (X, Y, Z). A rotary or second linear
// axis may be told to be at 0, where it always is.
void check_axes(const Words& words, std::size_t axes);

// Whether the axis words of a block, if it has some, are those of a move in the motion in force. G10, G28, G43.1 and
// G92 take them for themselves.
bool moves(const Codes& codes);

// Refuses a motion word in a block that does not move; I, J, K, P and R without use, and a P that could belong to more
// than one word: each was meant for something that is not there, and to go on without it would not be safe. `modes`:
// with those of the block.
void check_use(const Words& words, const Codes& codes, const Modes& modes);

// Those of H, L and Q that the block has a use for.
Letters used_letters(const Words& words, const Codes& codes, const Modes& modes);

}  // namespace kcs::gcode
