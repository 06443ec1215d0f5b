#include "server/gcode/without_effect.h"

#include <string>

namespace kcs::gcode {
namespace {

void note_codes(const Words& words, const Codes& codes, Notices& notices) {
  const std::uint32_t line = words.start().line;
  const int radius = codes[Group::kToolRadius];
  if (codes.has(Group::kSpindleMode)) {
    notices.add({'S'}, line, [] { return "Spindle modes (G96, G97) have no effect: S is the speed in 1/min."; });
  }
  if (words.has('T') || codes.has(Group::kToolChange)) {
    notices.add({'T'}, line,
                [] { return "Tools (T, M6) are not told apart: at M6 the tool rests, and nothing is changed."; });
  }
  if (words.has('H') || codes.has(Group::kToolLength)) {
    notices.add({'H'}, line,
                [] { return "Tool lengths (G43, G49, H) have no effect: every tool's length counts as zero."; });
  }
  if (words.has('D') || (radius != kNoCode && radius != code(40))) {
    notices.add({'D'}, line, [] {
      return "Tool radius compensation (G41, G42, D) has no effect: every tool's radius counts as zero, so that "
             "the tool's centre follows the programmed path.";
    });
  }
  if (codes.has(Group::kWorkOffset)) {
    notices.add({'G', code(54)}, line, [] {
      return "Work offsets (G54 to G59.3) count as zero: the program's coordinates are the machine's until G92 shifts "
             "them.";
    });
  }
  if (codes.has(Group::kRetract)) {
    notices.add({'G', code(98)}, line, [] { return "G98 and G99 have no effect: they concern canned cycles only."; });
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

void note_words_without_effect(const Words& words, const Codes& codes, Notices& notices) {
  note_codes(words, codes, notices);
  note_letters(words, letters("ELQ"), notices, " words are not known to kcs and were skipped.");
  note_letters(words, kMissingAxes, notices, " words were skipped: the machine has no such axis. All of them were 0.");
}

}  // namespace kcs::gcode
