// Spindle and coolant: what the program has switched on.
#pragma once

#include "server/gcode/codes.h"
#include "server/gcode/path_builder.h"
#include "server/gcode/place.h"
#include "server/gcode/words.h"
#include "server/planning/marker.h"

namespace kcs::gcode {

// The path carries every command as a marker at its place. Where the spindle starts, stops or turns the other way, the
// tool comes to rest: a tool that cuts must turn as it should. Coolant and another speed are switched on the way.
class Switches {
 public:
  // Does what a block says, in the order of RS-274: speed, spindle, coolant. Refuses a speed that is out of range.
  void execute(const Words& words, const Codes& codes, PathBuilder& builder);

  // Each if it is on.
  void stop_spindle(Place place, PathBuilder& builder);
  void stop_coolant(Place place, PathBuilder& builder);

 private:
  void turn(planning::MarkerKind direction, Place place, PathBuilder& builder);

  // What was said last; kNone: nothing yet, so that it may be either.
  planning::MarkerKind spindle_ = planning::MarkerKind::kNone;
  float speed_ = 0;  // S, 1/min
  bool coolant_is_on_ = false;
};

}  // namespace kcs::gcode
