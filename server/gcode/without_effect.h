// Words that kcs accepts although they have no effect on the path, and the notices that say so.
#pragma once

#include "server/gcode/codes.h"
#include "server/gcode/notices.h"
#include "server/gcode/words.h"

namespace kcs::gcode {

// Notes every word of a block that has no effect: of the spindle's mode, the tool table and work offsets, and letters
// that kcs does not know.
void note_words_without_effect(const Words& words, const Codes& codes, Notices& notices);

}  // namespace kcs::gcode
