#include "server/gcode/interpreter.h"

#include <cmath>
#include <string>
#include <utility>

#include "server/gcode/without_effect.h"
#include "server/planning/options.h"

namespace kcs::gcode {
namespace {

namespace range = planning::range;

constexpr std::string_view kAxisLetters = "XYZ";
constexpr std::string_view kCentreLetters = "IJK";
constexpr Letters kAxes = letters(kAxisLetters);
constexpr Letters kCentre = letters(kCentreLetters);
constexpr double kMaxTurns = 1e6;
constexpr double kSmallestShortfall = 1e-6;  // mm, of a radius, that is worth a notice

}  // namespace

Interpreter::Interpreter(const Options& options, TakeSegment take, Notices& notices)
    : options_(options),
      notices_(notices),
      builder_(options.start, std::move(take), options.max_segments, options.max_chords),
      modes_(options) {}

void Interpreter::execute(const Words& words) {
  const Codes codes(words, notices_);
  if (codes.is_skipped_whole()) {
    skip(words);
    return;
  }
  modes_.apply(words, codes, options_);
  check_axes(words);
  check_use(words, codes);
  note_words_without_effect(words, codes, notices_);
  if (codes.has(Group::kToolChange)) change_tool(codes);
  switches_.execute(words, codes, builder_);
  switch (codes[Group::kThisBlock]) {
    case code(4):
      dwell(words, codes);
      break;
    case code(92):
      set_offset(words, codes);
      break;
    case code(92, 1):
      saved_offset_ = Vector::Zero();
      [[fallthrough]];
    case code(92, 2):
      offset_ = Vector::Zero();
      break;
    case code(92, 3):
      offset_ = saved_offset_;
      break;
    default:
      break;
  }
  if (codes[Group::kThisBlock] != code(92)) move(words, codes);
  stop(codes);
}

// A block that is one unknown M word with what follows it. If that could be a move, leaving it out is not safe.
void Interpreter::skip(const Words& words) {
  const Letters axis_words = words.present() & (modes_.is_arc() ? kAxes | kCentre : kAxes);
  if (axis_words == 0) return;
  const Code& word = words.codes().front();
  const std::string name = code_name(word.letter, word.tenths);
  if (modes_.motion != Motion::kNone && !is_printer_setting(word.tenths)) {
    refuse(words.first_of(axis_words),
           name +
               " is not known to kcs, so that this word could be a setting of it or a move. Remove the block, or "
               "write the move in a block of its own.");
  }
  notices_.add({'X', word.tenths}, word.place.line, [&] {
    std::string list;
    for (const char letter : std::string_view("XYZIJK")) {
      if (words.has_any(axis_words & letters({&letter, 1}))) list += std::string(list.empty() ? "" : ", ") + letter;
    }
    return "Axis words (" + list + ") beside " + name +
           " were skipped with it: they were taken for settings, not for a move.";
  });
}

void Interpreter::check_axes(const Words& words) const {
  if (options_.axes == 2 && words.has('Z')) {
    refuse(words.place('Z'), "a Z word for a machine with two axes (X, Y). Remove it, or choose a machine with three.");
  }
  for (const char letter : {'A', 'B', 'C', 'U', 'V', 'W'}) {
    if (words.has(letter) && words.value(letter) != 0) {
      refuse(words.place(letter), "the machine has no axis " + std::string(1, letter) +
                                      ". Write the program for the axes X, Y and Z; only a word of 0 may stay.");
    }
  }
}

// A word without use was meant for something that is not there: to go on without it would not be safe.
void Interpreter::check_use(const Words& words, const Codes& codes) const {
  if (!words.has_any(kCentre | letters("PR")) || codes.has_skipped()) return;
  const bool dwells = codes[Group::kThisBlock] == code(4);
  const bool blends = codes[Group::kPathControl] == code(64);
  const bool turns = modes_.is_arc() && codes[Group::kThisBlock] != code(92) && words.has_any(kCentre | letters("R"));
  if (words.has('P') && dwells + blends + turns > 1) {
    refuse(words.place('P'), "P could belong to more than one word of this block. Make two blocks of it.");
  }
  const Letters useful = (turns ? kCentre | letters("PR") : 0) | (dwells || blends ? letters("P") : 0);
  const Letters useless = words.present() & (kCentre | letters("PR")) & ~useful;
  if (useless != 0) {
    refuse(words.first_of(useless),
           "a word without use in this block: I, J, K and R belong to G2 and G3, P to G2, G3, G4 "
           "and G64. Add what it was meant for, or remove it.");
  }
}

void Interpreter::dwell(const Words& words, const Codes& codes) {
  const Place place = codes.place(Group::kThisBlock);
  if (!words.has('P')) refuse(place, "G4 needs its time: P in seconds.");
  if (words.has_any(kAxes) && !codes.has(Group::kMotion)) {
    refuse(words.first_of(kAxes),
           "an axis word in a block with G4. The time is P, in seconds; write a move in a block of its own.");
  }
  const double duration = words.value('P');
  if (duration < 0) refuse(words.place('P'), "a dwell below zero. P is a time in seconds.");
  if (duration > 0) {
    builder_.dwell(duration, words.place('P'));
  } else {
    builder_.rest();
  }
}

void Interpreter::set_offset(const Words& words, const Codes& codes) {
  const Place place = codes.place(Group::kThisBlock);
  if (!words.has_any(kAxes)) {
    if ((words.present() & ~letters("N")) == 0) {
      refuse(place, "G92 needs at least one of X, Y and Z. G92.1 removes the offset.");
    }
    notices_.add({'G', code(92)}, place.line, [] { return "G92 without X, Y or Z has no effect."; });
    return;
  }
  if (codes.has(Group::kMotion)) {
    refuse(place, "G92 takes the axis words of its block. Write the move in a block of its own.");
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (words.has(kAxisLetters[axis])) offset_[axis] = builder_.position()[axis] - length(words, kAxisLetters[axis]);
  }
  saved_offset_ = offset_;
}

void Interpreter::move(const Words& words, const Codes& codes) {
  if (!words.has_any(modes_.is_arc() ? kAxes | kCentre | letters("R") : kAxes)) return;
  if (modes_.motion == Motion::kNone) {
    refuse(words.first_of(kAxes), "no motion is in force. Write G0, G1, G2 or G3.");
  }
  const Vector end = target(words, codes);
  Manner manner{.tolerance = modes_.tolerance, .rests = modes_.rests_after_every_move, .place = words.start()};
  if (modes_.is_arc() && words.has_any(kCentre | letters("R"))) {
    const Arc arc = arc_to(end, words);
    note_mismatch(arc, manner.place);
    if (words.has('R')) note_shortfall(arc, length(words, 'R'), words.place('R'));
    manner.feed = feed_of_move(words, arc.length());
    builder_.arc(arc, manner);
    return;
  }
  if (modes_.is_arc()) note_missing_centre(words, codes);
  if (end == builder_.position()) return;
  manner.feed = modes_.motion == Motion::kRapid ? options_.feed.value_or(options_.rapid)
                                                : feed_of_move(words, (end - builder_.position()).norm());
  builder_.line(end, manner);
}

void Interpreter::note_mismatch(const Arc& arc, Place place) {
  if (!arc.has_mismatch()) return;
  notices_.add({'I'}, place.line, [&] {
    return "An arc starts " + std::to_string(arc.start_radius()) + " mm from its centre and ends " +
           std::to_string(arc.end_radius()) + " mm from it: the radius changes steadily. Check I, J and K.";
  });
}

void Interpreter::note_shortfall(const Arc& arc, double radius, Place place) {
  const double shortfall = arc.start_radius() - std::abs(radius);
  if (shortfall < kSmallestShortfall) return;
  notices_.add({'r'}, place.line, [&] {
    return "An arc's end is farther from its start than twice its radius R. Up to 0.001 mm too little radius counts "
           "as rounding: it was taken as half a circle of radius " +
           std::to_string(arc.start_radius()) + " mm.";
  });
}

// A block with G2 or G3 in it is an arc whose centre got lost. Without them it is rather a line whose G1 was forgotten
// after an arc; controls that are in wide use go straight there.
void Interpreter::note_missing_centre(const Words& words, const Codes& codes) {
  if (codes.has(Group::kMotion)) {
    refuse(words.start(), "the arc's centre is missing. Write I, J or K, or the radius R.");
  }
  notices_.add({'R'}, words.start().line, [] {
    return "A move under G2 or G3 without centre and radius was taken as a straight line. Write G1 before it.";
  });
}

// Nobody changes a tool that turns.
void Interpreter::change_tool(const Codes& codes) {
  builder_.rest();
  switches_.stop_spindle(codes.place(Group::kToolChange), builder_);
}

// The end of a program leaves nothing on.
void Interpreter::stop(const Codes& codes) {
  if (!codes.has(Group::kStopping)) return;
  builder_.rest();
  program_has_ended_ = codes[Group::kStopping] == code(2) || codes[Group::kStopping] == code(30);
  if (!program_has_ended_) return;
  switches_.stop_spindle(codes.place(Group::kStopping), builder_);
  switches_.stop_coolant(codes.place(Group::kStopping), builder_);
}

// The length that a word states, mm.
double Interpreter::length(const Words& words, char letter) const {
  const double value = words.value(letter) * modes_.unit;
  if (std::abs(value) > range::kCoordinate) {
    refuse(words.place(letter), "a length of more than 1e7 mm. Check the number and the units (G20, G21).");
  }
  return value;
}

// Where the move ends, in machine coordinates.
Vector Interpreter::target(const Words& words, const Codes& codes) const {
  const bool in_machine_coordinates = codes[Group::kThisBlock] == code(53);
  if (in_machine_coordinates && (modes_.is_arc() || modes_.incremental)) {
    refuse(codes.place(Group::kThisBlock), "G53 goes with G0 or G1, and with G90.");
  }
  Vector end = builder_.position();
  for (int axis = 0; axis < 3; ++axis) {
    const char letter = kAxisLetters[axis];
    if (!words.has(letter)) continue;
    const double value = length(words, letter);
    if (in_machine_coordinates) {
      end[axis] = value;
    } else if (modes_.incremental) {
      end[axis] += value;
    } else {
      end[axis] = value + offset_[axis];
    }
    if (std::abs(end[axis]) > range::kCoordinate) {
      refuse(words.place(letter), "the move ends more than 1e7 mm from zero. Check G91 and G92.");
    }
  }
  return end;
}

Arc Interpreter::arc_to(const Vector& target, const Words& words) const {
  if (options_.axes == 2 && modes_.plane.normal != kPlaneXy.normal) {
    refuse(words.start(), "an arc in a plane with Z (G18, G19) for a machine with two axes. Write G17 before it.");
  }
  const Turn turn = modes_.motion == Motion::kClockwiseArc ? Turn::kClockwise : Turn::kCounterclockwise;
  const Vector& start = builder_.position();
  if (!words.has('R')) {
    return Arc::about_centre(start, target, centre(words), modes_.plane, turn, turns(words), words.start());
  }
  if (words.has_any(kCentre)) {
    refuse(words.place('R'), "an arc with a radius (R) and a centre (I, J, K). Keep one of them.");
  }
  return Arc::of_radius(start, target, length(words, 'R'), modes_.plane, turn, turns(words), words.place('R'));
}

// The centre of the block's arc in its plane, in machine coordinates.
Eigen::Vector2d Interpreter::centre(const Words& words) const {
  const Plane& plane = modes_.plane;
  const char first = kCentreLetters[plane.first];
  const char second = kCentreLetters[plane.second];
  const char normal = kCentreLetters[plane.normal];
  const std::string both = std::string(1, first) + " and " + second;
  if (words.has(normal) && words.value(normal) != 0) {
    refuse(words.place(normal), "the arc's plane has no " + std::string(1, normal) + ": it takes " + both +
                                    ". Choose the plane with G17, G18 or G19.");
  }
  const int given = words.has(first) + words.has(second);
  if (given == 0 || (given == 1 && modes_.absolute_centres)) {
    refuse(words.start(), "the arc's centre is missing. Write " + both +
                              (modes_.absolute_centres ? " (G90.1 needs both)." : ", or the radius R."));
  }
  const Vector base = modes_.absolute_centres ? offset_ : builder_.position();
  Eigen::Vector2d centre = plane.of(base);
  if (words.has(first)) centre.x() += length(words, first);
  if (words.has(second)) centre.y() += length(words, second);
  return centre;
}

int Interpreter::turns(const Words& words) const {
  if (!words.has('P')) return 1;
  const double turns = words.value('P');
  if (turns < 1 || turns > kMaxTurns || turns != std::floor(turns)) {
    refuse(words.place('P'), "P of an arc counts its turns: a whole number from 1 to 1000000.");
  }
  return static_cast<int>(turns);
}

double Interpreter::feed_of_move(const Words& words, double length) const {
  if (options_.feed) return *options_.feed;
  if (modes_.inverse_time) {
    if (!words.has('F')) refuse(words.start(), "with G93 every G1, G2 and G3 block needs its F, 1/min.");
    return checked_feed(length * words.value('F') / 60, words.place('F'));
  }
  if (modes_.feed == 0) refuse(words.start(), "no feed is set. Write F before or in this block.");
  return modes_.feed;
}

}  // namespace kcs::gcode
