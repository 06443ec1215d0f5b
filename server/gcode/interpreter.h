// What the blocks of a program mean.
#pragma once

#include <array>
#include <optional>

#include "server/gcode/codes.h"
#include "server/gcode/coordinates.h"
#include "server/gcode/cycles.h"
#include "server/gcode/modes.h"
#include "server/gcode/notices.h"
#include "server/gcode/offsets.h"
#include "server/gcode/options.h"
#include "server/gcode/path_builder.h"
#include "server/gcode/switches.h"
#include "server/gcode/words.h"
#include "server/planning/toolpath.h"

namespace kcs::gcode {

// Executes blocks one after the other. Within a block the order is that of RS-274, whatever the order of its words:
// modes, tool change, spindle, coolant, dwell, offset or move, stop.
// What differs from a machine: work offsets and tool lengths that the operator set there count as zero, so that the
// program's coordinates are the machine's until the program itself shifts them. Where a program relies on one, that is
// noted.
class Interpreter {
 public:
  // `take` gets the moves, the last one at the end; `notices` must outlive the interpreter.
  Interpreter(const Options& options, TakeSegment take, Notices& notices);

  // Executes one block. Refuses what cannot be done safely, naming the place.
  void execute(const Words& words);
  // After the last block.
  void finish() { builder_.finish(); }

  // M2 or M30 came.
  bool program_has_ended() const { return program_has_ended_; }

  const Modes& modes() const { return modes_; }
  // Where the tool is in the program's coordinates, mm.
  Vector program_position() const { return coordinates().to_program(builder_.position()); }
  const Coordinates& coordinates() const { return offsets_.coordinates(); }

  // Largest distance between an arc and its chords so far, mm.
  double largest_chord_error() const { return builder_.largest_chord_error(); }

 private:
  void skip(const Words& words);
  void dwell(const Words& words, const Codes& codes);
  void move(const Words& words, const Codes& codes);
  void drill(const Words& words, const Codes& codes);
  void go_to_stored_position(const Words& words, const Codes& codes);
  void note_missing_centre(const Words& words, const Codes& codes);
  void change_tool(const Codes& codes);
  void stop(const Codes& codes);

  Manner manner_of(const Words& words) const;
  double rapid() const { return options_.feed.value_or(options_.rapid); }
  Vector target(const Words& words, const Codes& codes) const;
  Vector checked(const Vector& end, const Words& words) const;
  double feed_of_move(const Words& words, double length) const;

  Options options_;
  Notices& notices_;
  PathBuilder builder_;
  Switches switches_;
  Modes modes_;
  Offsets offsets_;
  Cycles cycles_;
  std::array<std::optional<Vector>, 2> stored_positions_;  // of G28.1 and G30.1, machine coordinates
  bool program_has_ended_ = false;
};

}  // namespace kcs::gcode
