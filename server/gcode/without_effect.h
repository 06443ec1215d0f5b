// Words that kcs accepts although they have no effect on the path, and the notices that say so.
#pragma once

#include "server/gcode/codes.h"
#include "server/gcode/modes.h"
#include "server/gcode/notices.h"
#include "server/gcode/words.h"

namespace kcs::gcode {

// Notes every word of a block that has no effect: of the spindle's mode and the tool, and letters that kcs does not
// know. `modes`: with those of the block.
void note_words_without_effect(const Words& words, const Codes& codes, const Modes& modes, Notices& notices);

}  // namespace kcs::gcode
