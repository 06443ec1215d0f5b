#include "server/gcode/interpreter.h"

#include <string>
#include <utility>

#include "server/gcode/arc_words.h"
#include "server/gcode/lengths.h"
#include "server/gcode/use_of_words.h"
#include "server/gcode/without_effect.h"
#include "server/planning/options.h"

namespace kcs::gcode {
Interpreter::Interpreter(const Options& options, TakeSegment take, Notices& notices)
    : options_(options),
      notices_(notices),
      builder_(options.start, std::move(take), options.max_segments, options.max_chords),
      modes_(options),
      offsets_(notices) {}

void Interpreter::execute(const Words& words) {
  const Codes codes(words, notices_);
  if (codes.is_skipped_whole()) {
    skip(words);
    return;
  }
  modes_.apply(words, codes, options_);
  check_axes(words, options_.axes);
  check_use(words, codes, modes_);
  note_words_without_effect(words, codes, modes_, notices_);
  offsets_.choose(words, codes, modes_.unit);
  if (codes.has(Group::kToolChange)) change_tool(codes);
  switches_.execute(words, codes, modes_.unit, builder_);
  if (codes.has(Group::kMotion) && modes_.motion != Motion::kCycle) cycles_.end();
  switch (codes[Group::kThisBlock]) {
    case code(4):
      dwell(words, codes);
      break;
    case code(28):
    case code(30):
      go_to_stored_position(words, codes);
      break;
    case code(28, 1):
      stored_positions_[0] = builder_.position();
      break;
    case code(30, 1):
      stored_positions_[1] = builder_.position();
      break;
    default:
      offsets_.set(words, codes, modes_.unit, builder_.position());
      break;
  }
  if (moves(codes)) move(words, codes);
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

void Interpreter::move(const Words& words, const Codes& codes) {
  if (!words.has_any(modes_.is_arc() ? kAxes | kCentre | letters("R") : kAxes)) {
    if (codes.has(Group::kMotion) && modes_.motion == Motion::kCycle) {
      refuse(codes.place(Group::kMotion), "a canned cycle without X, Y or Z. Write where its hole is.");
    }
    return;
  }
  if (modes_.motion == Motion::kNone) {
    refuse(words.first_of(kAxes), "no motion is in force. Write G0, G1, G2 or G3.");
  }
  if (modes_.motion == Motion::kCycle) {
    drill(words, codes);
    return;
  }
  const Vector end = target(words, codes);
  Manner manner = manner_of(words);
  if (modes_.is_arc() && words.has_any(kCentre | letters("R"))) {
    if (options_.axes == 2 && modes_.plane.normal != kPlaneXy.normal) {
      refuse(words.start(), "an arc in a plane with Z (G18, G19) for a machine with two axes. Write G17 before it.");
    }
    const Arc arc = arc_of(words, modes_, offsets_.coordinates(), builder_.position(), end, notices_);
    manner.feed = feed_of_move(words, arc.length());
    builder_.arc(arc, manner);
    return;
  }
  if (modes_.is_arc()) note_missing_centre(words, codes);
  if (end == builder_.position()) return;
  manner.feed = modes_.motion == Motion::kRapid ? rapid() : feed_of_move(words, (end - builder_.position()).norm());
  builder_.line(end, manner);
}

// The holes of a canned cycle. Their moves are followed exactly, whatever tolerance is in force.
void Interpreter::drill(const Words& words, const Codes& codes) {
  if (codes[Group::kThisBlock] == code(53)) {
    refuse(codes.place(Group::kThisBlock), "G53 goes with G0 or G1, and with G90.");
  }
  if (modes_.inverse_time && !options_.feed) {
    refuse(words.start(), "canned cycles need a feed in mm/min (G94): under G93 F is a time of a single move.");
  }
  const double feed = feed_of_move(words, 0);
  Manner manner = manner_of(words);
  manner.tolerance = 0;
  cycles_.execute(words, modes_, program_position(), [&](const CycleStep& step) {
    switch (step.kind) {
      case CycleStep::Kind::kDwell:
        if (step.duration > 0) builder_.dwell(step.duration, words.start());
        return;
      case CycleStep::Kind::kStopSpindle:
        return switches_.stop_spindle(words.start(), builder_);
      case CycleStep::Kind::kRestartSpindle:
        return switches_.restart_spindle(words.start(), builder_);
      default:
        break;
    }
    const Vector end = checked(offsets_.coordinates().moved(builder_.position(), step.to, false), words);
    manner.feed = step.kind == CycleStep::Kind::kRapid ? rapid() : feed;
    builder_.line(end, manner);
  });
}

// G28 and G30: past a point that the block may state, to where G28.1 or G30.1 came.
void Interpreter::go_to_stored_position(const Words& words, const Codes& codes) {
  const bool is_first = codes[Group::kThisBlock] == code(28);
  const std::optional<Vector>& stored = stored_positions_[is_first ? 0 : 1];
  if (!stored) {
    const std::string name = is_first ? "G28" : "G30";
    refuse(codes.place(Group::kThisBlock),
           name +
               ": kcs does not know the machine's stored positions, so it cannot go there. Store one in the program (" +
               name +
               ".1 where the tool is to come back to), write the position as a move, such as G53 G0 Z0, or end "
               "the program here.");
  }
  Manner manner = manner_of(words);
  manner.feed = rapid();
  Vector end = *stored;
  if (words.has_any(kAxes)) {
    const Stated stated = stated_by(words, modes_.unit);
    builder_.line(checked(offsets_.coordinates().moved(builder_.position(), stated, modes_.incremental), words),
                  manner);
    for (int axis = 0; axis < 3; ++axis) {
      if (!stated[static_cast<std::size_t>(axis)]) end[axis] = builder_.position()[axis];
    }
  }
  builder_.line(end, manner);
}

Manner Interpreter::manner_of(const Words& words) const {
  return {.tolerance = modes_.tolerance, .rests = modes_.rests_after_every_move, .place = words.start()};
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

// Where the move ends, in machine coordinates.
Vector Interpreter::target(const Words& words, const Codes& codes) const {
  const bool in_machine_coordinates = codes[Group::kThisBlock] == code(53);
  if (in_machine_coordinates && (modes_.is_arc() || modes_.incremental || words.has_any(kPolar))) {
    refuse(codes.place(Group::kThisBlock), "G53 goes with G0 or G1, with G90, and with X, Y and Z.");
  }
  const Stated stated = stated_move(words, modes_.unit, modes_.incremental, program_position());
  Vector end = builder_.position();
  if (in_machine_coordinates) {
    for (int axis = 0; axis < 3; ++axis) end[axis] = stated[static_cast<std::size_t>(axis)].value_or(end[axis]);
  } else {
    end = offsets_.coordinates().moved(end, stated, modes_.incremental);
  }
  return checked(end, words);
}

// Returns `end`. Refuses, naming the words that lead there, what lies out of the planner's range.
Vector Interpreter::checked(const Vector& end, const Words& words) const {
  if (end.cwiseAbs().maxCoeff() > planning::range::kCoordinate) {
    refuse(words.first_of(kAxes), "the move ends more than 1e7 mm from zero. Check G91 and the offsets (G10, G92).");
  }
  return end;
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
