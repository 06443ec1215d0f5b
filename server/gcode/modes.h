// What stays in force from block to block.
#pragma once

#include "server/gcode/arc.h"
#include "server/gcode/codes.h"
#include "server/gcode/options.h"
#include "server/gcode/place.h"
#include "server/gcode/words.h"

namespace kcs::gcode {

enum class Motion { kNone, kRapid, kLine, kClockwiseArc, kCounterclockwiseArc, kCycle };

// The members begin with what is in force when a program starts.
struct Modes {
  explicit Modes(const Options& options) : tolerance(options.tolerance) {}

  // Takes over what a block says. Refuses a feed or a tolerance that is out of range.
  // Units come first: those of a block hold for all of its numbers (RS-274 would read an F beside a G20 in the unit of
  // the block before, which nobody expects).
  void apply(const Words& words, const Codes& codes, const Options& options);

  bool is_arc() const { return motion == Motion::kClockwiseArc || motion == Motion::kCounterclockwiseArc; }

  Motion motion = Motion::kNone;
  int cycle = kNoCode;        // which one, with Motion::kCycle: G81 is 810
  bool retracts_to_r = true;  // out of the holes of a cycle (G99); otherwise to where the tool was before (G98)
  Plane plane = kPlaneXy;
  double unit = 1;  // mm; the program's unit of length
  bool incremental = false;
  bool absolute_centres = false;
  bool inverse_time = false;
  double feed = 0;  // mm/s; 0: none is set. With inverse_time each block brings its own.
  // mm, how far the tool may leave the path at corners. 0: not at all (G61, G61.1), the tool rests there.
  double tolerance;
  bool rests_after_every_move = false;  // G61.1

 private:
  void apply_feed(const Words& words, const Codes& codes);
  void apply_motion(int word);
  void apply_plane(int word);
  void apply_path_control(const Words& words, int word, double usual_tolerance);
};

// Returns `feed` (mm/s). Refuses, naming `place`, one that is out of the planner's range.
double checked_feed(double feed, Place place);

}  // namespace kcs::gcode
