#include "server/gcode/codes.h"

#include <optional>

namespace kcs::gcode {
namespace {

// Why a G word cannot be done, and what to write instead.
std::string refusal_of_g(int tenths) {
  switch (tenths) {
    case code(5):
    case code(5, 1):
    case code(5, 2):
    case code(5, 3):
      return "splines are not supported. Let the CAM program write lines and arcs.";
    case code(7):
      return "diameters (a lathe's X) are not supported: kcs takes X as it is. Write radii (G8).";
    case code(33):
    case code(33, 1):
    case code(76):
    case code(95):
      return "kcs does not know the spindle's speed, so it cannot follow the spindle. Use G94 and a feed in mm/min.";
    case code(38, 2):
    case code(38, 3):
    case code(38, 4):
    case code(38, 5):
      return "where probing ends is not known before it is done. Probe before the program, and plan the program "
             "without.";
    case code(41):
    case code(41, 1):
    case code(42):
    case code(42, 1):
      return "cutter compensation is not supported: kcs does not know the tool's radius. Let the CAM program write the "
             "path of the tool's centre (compensation in the computer, not in the control); if it has, remove the "
             "word.";
    case code(68):
    case code(69):
      return "Fanuc's turned coordinates are not supported. To turn a work offset write G10 L2 P1 R45 (degrees); where "
             "nothing is turned remove the word.";
    case code(70):
    case code(71):
    case code(71, 1):
    case code(71, 2):
    case code(72):
    case code(72, 1):
    case code(72, 2):
      return "cycles of turning are not supported. Let the CAM program write out the moves of the cycle.";
    case code(74):
    case code(84):
      return "in a tapped hole the feed must follow the spindle, also while it is held or slowed down, which kcs "
             "cannot "
             "make it do. With a floating tap holder write the moves: G1 down, M4 (M3 for a left-hand thread), G1 up.";
    case code(87):
      return "back boring, with a spindle that stops in a certain direction, is not supported. Let the CAM program "
             "write out the moves of the cycle.";
    case code(88):
      return "a cycle in which the operator retracts the tool is not supported. Use G86 or G89, or write G1 down, M0 "
             "and the retract.";
    default:
      return "kcs does not know this word, and the tool might move wrongly without it. Remove it or write it "
             "differently.";
  }
}

Group group_of_g(const Code& word) {
  switch (word.tenths) {
    case code(4):
    case code(10):
    case code(28):
    case code(28, 1):
    case code(30):
    case code(30, 1):
    case code(52):
    case code(53):
    case code(92):
    case code(92, 1):
    case code(92, 2):
    case code(92, 3):
      return Group::kThisBlock;
    case code(0):
    case code(1):
    case code(2):
    case code(3):
    case code(73):
    case code(80):
    case code(81):
    case code(82):
    case code(83):
    case code(85):
    case code(86):
    case code(89):
      return Group::kMotion;
    case code(17):
    case code(18):
    case code(19):
      return Group::kPlane;
    case code(90):
    case code(91):
      return Group::kDistance;
    case code(90, 1):
    case code(91, 1):
      return Group::kArcCentres;
    case code(93):
    case code(94):
      return Group::kFeedMode;
    case code(20):
    case code(21):
      return Group::kUnits;
    case code(40):
      return Group::kToolRadius;
    case code(43):
    case code(43, 1):
    case code(43, 2):
    case code(49):
      return Group::kToolLength;
    case code(8):
      return Group::kDiameters;
    case code(98):
    case code(99):
      return Group::kRetract;
    case code(54):
    case code(55):
    case code(56):
    case code(57):
    case code(58):
    case code(59):
    case code(59, 1):
    case code(59, 2):
    case code(59, 3):
      return Group::kWorkOffset;
    case code(61):
    case code(61, 1):
    case code(64):
      return Group::kPathControl;
    case code(96):
    case code(97):
      return Group::kSpindleMode;
    default:
      refuse(word.place, code_name('G', word.tenths) + ": " + refusal_of_g(word.tenths));
  }
}

// Nothing for an M word that kcs does not know.
std::optional<Group> group_of_m(const Code& word) {
  switch (word.tenths) {
    case code(0):
    case code(1):
    case code(2):
    case code(30):
    case code(60):
      return Group::kStopping;
    case code(6):
      return Group::kToolChange;
    case code(3):
    case code(4):
    case code(5):
      return Group::kSpindle;
    case code(7):
    case code(8):
    case code(9):
      return Group::kCoolant;
    case code(48):
    case code(49):
      return Group::kOverrides;
    case code(98):
    case code(99):
      refuse(word.place, code_name('M', word.tenths) +
                             ": subprograms are not supported. Let the CAM program write out every move.");
    default:
      return std::nullopt;
  }
}

}  // namespace

std::string code_name(char letter, int tenths) {
  std::string name = letter + std::to_string(tenths / 10);
  if (tenths % 10 != 0) name += "." + std::to_string(tenths % 10);
  return name;
}

bool is_printer_setting(int tenths) {
  switch (tenths) {
    case code(92):   // steps per mm
    case code(201):  // largest accelerations
    case code(203):  // largest speeds
    case code(204):  // accelerations
    case code(205):  // jumps of speed
    case code(206):  // home offsets
    case code(350):  // microsteps
    case code(566):  // jumps of speed
    case code(900):  // pressure advance
    case code(906):  // motor currents
    case code(907):
      return true;
    default:
      return false;
  }
}

Codes::Codes(const Words& words, Notices& notices) {
  tenths_.fill(kNoCode);
  for (const Code& word : words.codes()) {
    const std::optional<Group> group = word.letter == 'G' ? group_of_g(word) : group_of_m(word);
    if (!group) {
      has_skipped_ = true;
      is_skipped_whole_ = words.codes().size() == 1 && word.place.column == words.start().column;
      notices.add({'M', word.tenths}, word.place.line,
                  [&] { return code_name('M', word.tenths) + " is not known to kcs and was skipped."; });
      continue;
    }
    if (has(*group)) {
      refuse(word.place, code_name(word.letter, word.tenths) + " and " + code_name(word.letter, (*this)[*group]) +
                             " exclude each other in one block. Keep one, or make two blocks of it.");
    }
    tenths_[static_cast<std::size_t>(*group)] = word.tenths;
    places_[static_cast<std::size_t>(*group)] = word.place;
  }
}

}  // namespace kcs::gcode
