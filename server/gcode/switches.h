// Spindle and coolant: what the program has switched on.
#pragma once

#include <optional>

#include "server/gcode/codes.h"
#include "server/gcode/path_builder.h"
#include "server/gcode/place.h"
#include "server/gcode/words.h"
#include "server/planning/marker.h"

namespace kcs::gcode {

// The path carries every command as a marker at its place. Where the spindle starts, stops or turns the other way, the
// tool comes to rest: a tool that cuts must turn as it should. Coolant and another speed are switched on the way.
// Under G96 S is the speed of the cut, and the spindle's follows from a radius that only the machine knows: a marker
// says so where the spindle turns.
class Switches {
 public:
  // Does what a block says, in the order of RS-274: speed, spindle, coolant. `unit`: the program's unit of length, mm.
  // Refuses a speed that is missing or out of range.
  void execute(const Words& words, const Codes& codes, double unit, PathBuilder& builder);

  // Each if it is on.
  void stop_spindle(Place place, PathBuilder& builder);
  void stop_coolant(Place place, PathBuilder& builder);
  // Turns the spindle again as it turned before stop_spindle().
  void restart_spindle(Place place, PathBuilder& builder);

 private:
  // Takes over G96 or G97.
  void choose_mode(const Words& words, const Codes& codes, PathBuilder& builder);
  void turn(planning::MarkerKind direction, Place place, PathBuilder& builder);

  // What was said last; kNone: nothing yet, so that it may be either.
  planning::MarkerKind spindle_ = planning::MarkerKind::kNone;
  planning::MarkerKind stopped_ = planning::MarkerKind::kNone;  // how the spindle turned before stop_spindle()
  float speed_ = 0;                                             // S, 1/min
  std::optional<float> surface_speed_;                          // S under G96, m/min
  bool coolant_is_on_ = false;
};

}  // namespace kcs::gcode
