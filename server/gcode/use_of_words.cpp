#include "server/gcode/use_of_words.h"

#include <string>

#include "server/gcode/arc_words.h"
#include "server/gcode/lengths.h"

namespace kcs::gcode {
namespace {

constexpr Letters kChecked = letters("IJKPR");

bool drills(const Words& words, const Codes& codes, const Modes& modes) {
  return modes.motion == Motion::kCycle && moves(codes) && words.has_any(kAxes);
}

}  // namespace

bool moves(const Codes& codes) {
  switch (codes[Group::kThisBlock]) {
    case code(10):
    case code(28):
    case code(28, 1):
    case code(30):
    case code(30, 1):
    case code(52):
    case code(92):
      return false;
    default:
      return codes[Group::kToolLength] != code(43, 1);
  }
}

void check_axes(const Words& words, std::size_t axes) {
  if (axes == 2 && words.has('Z')) {
    refuse(words.place('Z'), "a Z word for a machine with two axes (X, Y). Remove it, or choose a machine with three.");
  }
  for (const char letter : {'A', 'B', 'C', 'U', 'V', 'W'}) {
    if (words.has(letter) && words.value(letter) != 0) {
      refuse(words.place(letter), "the machine has no axis " + std::string(1, letter) +
                                      ". Write the program for the axes X, Y and Z; only a word of 0 may stay.");
    }
  }
}

void check_use(const Words& words, const Codes& codes, const Modes& modes) {
  if (!moves(codes) && codes.has(Group::kMotion)) {
    const Group group = codes[Group::kToolLength] == code(43, 1) ? Group::kToolLength : Group::kThisBlock;
    refuse(codes.place(group),
           code_name('G', codes[group]) + " takes the axis words of its block. Write the move in a block of its own.");
  }
  if (!moves(codes) && words.has_any(kPolar)) {
    refuse(words.first_of(kPolar), "@ and ^ state where a move ends. Write X and Y here.");
  }
  if (!words.has_any(kChecked) || codes.has_skipped()) return;
  const bool dwells = codes[Group::kThisBlock] == code(4);
  const bool blends = codes[Group::kPathControl] == code(64);
  const bool sets = codes[Group::kThisBlock] == code(10);
  const bool turns = modes.is_arc() && moves(codes) && words.has_any(kCentre | letters("R"));
  const bool drills = gcode::drills(words, codes, modes);
  if (words.has('P') && dwells + blends + sets + turns + drills > 1) {
    refuse(words.place('P'), "P could belong to more than one word of this block. Make two blocks of it.");
  }
  Letters useful = 0;
  if (turns) useful |= kCentre | letters("PR");
  if (sets || drills) useful |= letters("PR");
  if (dwells || blends) useful |= letters("P");
  const Letters useless = words.present() & kChecked & ~useful;
  if (useless != 0) {
    refuse(words.first_of(useless),
           "a word without use in this block: I, J, K and R belong to G2 and G3, P to G2, G3, G4, G10 and G64, P and R "
           "to G10 and canned cycles. Add what it was meant for, or remove it.");
  }
}

Letters used_letters(const Words& words, const Codes& codes, const Modes& modes) {
  Letters used = 0;
  if (drills(words, codes, modes)) used |= letters("LQ");
  if (codes[Group::kThisBlock] == code(10)) used |= letters("L");
  if (codes.has(Group::kToolLength)) used |= letters("H");
  if (codes[Group::kPathControl] == code(64)) used |= letters("Q");
  return used;
}

}  // namespace kcs::gcode
