// What the blocks of a program mean.
#pragma once

#include "server/gcode/codes.h"
#include "server/gcode/modes.h"
#include "server/gcode/notices.h"
#include "server/gcode/options.h"
#include "server/gcode/path_builder.h"
#include "server/gcode/switches.h"
#include "server/gcode/words.h"
#include "server/planning/toolpath.h"

namespace kcs::gcode {

// Executes blocks one after the other. Within a block the order is that of RS-274, whatever the order of its words:
// modes, tool change, spindle, coolant, dwell, offset or move, stop.
// What differs from a machine: work offsets, tool lengths and tool radii count as zero; the program's coordinates are
// the machine's until G92 shifts them. Each such word is noted.
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
  Vector program_position() const { return builder_.position() - offset_; }

  // Largest distance between an arc and its chords so far, mm.
  double largest_chord_error() const { return builder_.largest_chord_error(); }

 private:
  void skip(const Words& words);
  void check_axes(const Words& words) const;
  void check_use(const Words& words, const Codes& codes) const;
  void dwell(const Words& words, const Codes& codes);
  void set_offset(const Words& words, const Codes& codes);
  void move(const Words& words, const Codes& codes);
  void note_mismatch(const Arc& arc, Place place);
  void note_shortfall(const Arc& arc, double radius, Place place);
  void note_missing_centre(const Words& words, const Codes& codes);
  void change_tool(const Codes& codes);
  void stop(const Codes& codes);

  double length(const Words& words, char letter) const;
  Vector target(const Words& words, const Codes& codes) const;
  Arc arc_to(const Vector& target, const Words& words) const;
  Eigen::Vector2d centre(const Words& words) const;
  int turns(const Words& words) const;
  double feed_of_move(const Words& words, double length) const;

  Options options_;
  Notices& notices_;
  PathBuilder builder_;
  Switches switches_;
  Modes modes_;
  Vector offset_ = Vector::Zero();        // of G92: machine less program coordinates, mm
  Vector saved_offset_ = Vector::Zero();  // what G92.3 brings back
  bool program_has_ended_ = false;
};

}  // namespace kcs::gcode
