// Words that kcs accepts although they have no effect on the path, and the notices that say so.
#pragma once

#include "server/gcode/codes.h"
#include "server/gcode/notices.h"
#include "server/gcode/words.h"

namespace kcs::gcode {

// Notes every word of a block that has no effect on the path: of the spindle, the coolant and the tool table, of work
// offsets, and letters that kcs does not know.
void note_words_without_effect(const Words& words, const Codes& codes, Notices& notices);

}  // namespace kcs::gcode
