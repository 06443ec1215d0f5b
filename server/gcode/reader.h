// Reads the tool path out of an RS-274 program (G-code).
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "server/gcode/execution.h"
#include "server/gcode/lines.h"
#include "server/gcode/notices.h"
#include "server/gcode/options.h"

namespace kcs::gcode {

// Give it the program in pieces, cut anywhere, then call finish(). How the program is cut makes no difference to the
// path. Beside the path, the reader needs memory for one line, the program's parameters, its subroutines and the loop
// that is running.
//
// Wherever a word takes a number, the program may compute it (expression.h). O words repeat, choose and call lines
// (execution.h); subroutines must stand in the program itself, before their calls.
// The program starts with G17 G21 G40 G49 G54 G64 G80 G90 G91.1 G94, and with no feed set. Lines that begin with '/'
// are skipped. The program ends with M2, M30 or a second '%'; what follows is not read.
//
// Both calls throw planning::InvalidInput, with the place in the program, if the program cannot be read or not be
// followed safely, and CapReached, which is one, at a cap of the options. After that the reader must not be used.
class Reader {
 public:
  // `take` gets the segments of the path, which starts at options.start, one behind what was read; the last one comes
  // at the end.
  Reader(const Options& options, TakeSegment take);
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  void read(std::string_view piece);
  void finish();

  // What the author of the program should know, in the order of the program.
  const std::vector<Notice>& notices() const { return notices_.list(); }

  // Largest distance between an arc and its chords, mm; 0 without arcs.
  double largest_chord_error() const { return execution_.largest_chord_error(); }

 private:
  void read_line(std::string_view text, std::uint32_t number);

  Notices notices_;
  Execution execution_;
  Lines lines_;
  bool has_begun_ = false;  // with '%'
  bool has_ended_ = false;
};

}  // namespace kcs::gcode
