// The arcs that the blocks of a program state.
#pragma once

#include "server/gcode/arc.h"
#include "server/gcode/coordinates.h"
#include "server/gcode/modes.h"
#include "server/gcode/notices.h"
#include "server/gcode/words.h"

namespace kcs::gcode {

inline constexpr Letters kCentre = letters("IJK");

// The arc of a block under G2 or G3 that has a centre (I, J, K) or a radius (R), from `start` to `end`, both in machine
// coordinates, mm. Notes where its ends do not quite fit together. Refuses, naming the place, what is no arc.
Arc arc_of(const Words& words, const Modes& modes, const Coordinates& coordinates, const Vector& start,
           const Vector& end, Notices& notices);

}  // namespace kcs::gcode
