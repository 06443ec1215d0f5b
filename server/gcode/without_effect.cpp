#include "server/gcode/without_effect.h"

#include <string>

#include "server/gcode/use_of_words.h"

namespace kcs::gcode {
namespace {

void note_codes(const Words& words, const Codes& codes, Notices& notices) {
  const std::uint32_t line = words.start().line;
  if (words.has('T') || codes.has(Group::kToolChange)) {
    notices.add({'T'}, line,
                [] { return "Tools (T, M6) are not told apart: at M6 the tool rests, and nothing is changed."; });
  }
  if (words.has('D') && codes[Group::kSpindleMode] != code(96)) {
    notices.add({'D'}, line, [] { return "Tool radii (D) have no effect: kcs does not know the tools."; });
  }
  if (codes.has(Group::kOverrides)) {
    notices.add({'M', code(48)}, line, [] { return "M48 and M49 have no effect: a plan knows no override switches."; });
  }
}

void note_letters(const Words& words, Letters set, Notices& notices, const char* text) {
  if (!words.has_any(set)) return;
  for (char letter = 'A'; letter <= 'Z'; ++letter) {
    if (!words.has_any(set & letters({&letter, 1}))) continue;
    notices.add({letter}, words.start().line, [&] { return letter + std::string(text); });
  }
}

}  // namespace

void note_words_without_effect(const Words& words, const Codes& codes, const Modes& modes, Notices& notices) {
  note_codes(words, codes, notices);
  note_letters(words, letters("EHLQ") & ~used_letters(words, codes, modes), notices,
               " words are not known to kcs and were skipped.");
  note_letters(words, kMissingAxes, notices, " words were skipped: the machine has no such axis. All of them were 0.");
}

}  // namespace kcs::gcode
