// The G and M words of one line, sorted into the modal groups of RS-274.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "server/gcode/notices.h"
#include "server/gcode/words.h"

namespace kcs::gcode {

// A block has at most one word of each group.
enum class Group : std::uint8_t {
  kThisBlock,  // G4, G10, G28, G53, G92: what holds for its own block only
  kMotion,
  kPlane,
  kDistance,
  kArcCentres,
  kFeedMode,
  kUnits,
  kToolRadius,
  kToolLength,
  kRetract,
  kDiameters,
  kWorkOffset,
  kPathControl,
  kSpindleMode,
  kStopping,
  kToolChange,
  kSpindle,
  kCoolant,
  kOverrides,
};
inline constexpr std::size_t kGroupCount = static_cast<std::size_t>(Group::kOverrides) + 1;

// A word's number times ten, the form in which words are compared: code(59, 1) is G59.1.
constexpr int code(int number, int tenth = 0) { return number * 10 + tenth; }
inline constexpr int kNoCode = -1;

// "G59.1" for 'G' and 591.
std::string code_name(char letter, int tenths);

// Whether an M word, given as its number times ten, is one with which 3D printers set up their axes, motors or pressure
// advance (M201 X500): the axis words beside it are settings, not a move.
bool is_printer_setting(int tenths);

class Codes {
 public:
  // Refuses two words of one group, G words that kcs does not know (the tool would move wrongly without them), and
  // words that it knows but cannot do. M words that it does not know are skipped with a notice.
  Codes(const Words& words, Notices& notices);

  // The word of a group, times ten; kNoCode if the block has none.
  int operator[](Group group) const { return tenths_[static_cast<std::size_t>(group)]; }
  bool has(Group group) const { return (*this)[group] != kNoCode; }
  Place place(Group group) const { return places_[static_cast<std::size_t>(group)]; }

  // The block has M words that were skipped; other words in it may have been meant for them.
  bool has_skipped() const { return has_skipped_; }
  // The block is one unknown M word with what follows it (M201 X500 Y500): nothing in it is for kcs.
  bool is_skipped_whole() const { return is_skipped_whole_; }

 private:
  std::array<int, kGroupCount> tenths_;
  std::array<Place, kGroupCount> places_;
  bool has_skipped_ = false;
  bool is_skipped_whole_ = false;
};

}  // namespace kcs::gcode
