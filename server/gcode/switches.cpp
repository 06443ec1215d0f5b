#include "server/gcode/switches.h"

#include "server/planning/range.h"

namespace kcs::gcode {
namespace {

using planning::MarkerKind;

bool turns(MarkerKind spindle) {
  return spindle == MarkerKind::kSpindleClockwise || spindle == MarkerKind::kSpindleCounterclockwise;
}

MarkerKind spindle_of(int word) {
  switch (word) {
    case code(3):
      return MarkerKind::kSpindleClockwise;
    case code(4):
      return MarkerKind::kSpindleCounterclockwise;
    default:
      return MarkerKind::kSpindleOff;
  }
}

MarkerKind coolant_of(int word) {
  switch (word) {
    case code(7):
      return MarkerKind::kMistOn;
    case code(8):
      return MarkerKind::kFloodOn;
    default:
      return MarkerKind::kCoolantOff;
  }
}

float checked_speed(const Words& words, char letter, double unit) {
  const double speed = words.value(letter) * unit;
  if (!(speed >= 0 && speed <= planning::range::kMaxSpindleSpeed)) {
    refuse(words.place(letter), "a spindle speed outside 0 to 1000000 per minute. M3 and M4 say which way it turns.");
  }
  return static_cast<float>(speed);
}

// The unit of surface speeds in a program with that unit of length (mm): metres, or feet, per minute.
double surface_unit(double unit) {
  constexpr double kMetresPerFoot = 0.3048;
  return unit == 1 ? 1 : kMetresPerFoot;
}

}  // namespace

void Switches::execute(const Words& words, const Codes& codes, double unit, PathBuilder& builder) {
  const bool has_mode = codes.has(Group::kSpindleMode);
  if (has_mode) choose_mode(words, codes, builder);
  // Beside a word that was skipped S may be its own, such as a printer's fan (M106 S255).
  const bool has_speed = words.has('S') && (has_mode || codes.has(Group::kSpindle) || !codes.has_skipped());
  if (has_speed && surface_speed_) surface_speed_ = checked_speed(words, 'S', surface_unit(unit));
  if (has_speed && !surface_speed_) speed_ = checked_speed(words, 'S', 1);
  if (codes.has(Group::kSpindle)) {
    turn(spindle_of(codes[Group::kSpindle]), codes.place(Group::kSpindle), builder);
  } else if (has_speed && turns(spindle_)) {
    turn(spindle_, words.place('S'), builder);
  }
  if (codes.has(Group::kCoolant)) {
    const MarkerKind coolant = coolant_of(codes[Group::kCoolant]);
    coolant_is_on_ = coolant != MarkerKind::kCoolantOff;
    builder.mark({.kind = coolant}, codes.place(Group::kCoolant));
  }
}

void Switches::choose_mode(const Words& words, const Codes& codes, PathBuilder& builder) {
  const Place place = codes.place(Group::kSpindleMode);
  if (codes[Group::kSpindleMode] == code(97)) {
    if (surface_speed_ && !words.has('S')) {
      refuse(place, "G97 after G96 without S: how fast the spindle turned last is not known here. Add S in 1/min.");
    }
    surface_speed_.reset();
    return;
  }
  if (!words.has('S')) refuse(place, "G96 needs S, the surface speed, in m/min (feet/min under G20). Add it.");
  surface_speed_ = 0;
  const float limit = words.has('D') ? checked_speed(words, 'D', 1) : 0;
  builder.mark({.speed = limit, .kind = MarkerKind::kSpindleSpeedLimit}, place);
}

void Switches::stop_spindle(Place place, PathBuilder& builder) {
  stopped_ = spindle_;
  if (turns(spindle_)) turn(MarkerKind::kSpindleOff, place, builder);
}

void Switches::restart_spindle(Place place, PathBuilder& builder) {
  if (turns(stopped_)) turn(stopped_, place, builder);
}

void Switches::stop_coolant(Place place, PathBuilder& builder) {
  if (!coolant_is_on_) return;
  coolant_is_on_ = false;
  builder.mark({.kind = MarkerKind::kCoolantOff}, place);
}

void Switches::turn(MarkerKind direction, Place place, PathBuilder& builder) {
  const bool is_new = direction != spindle_;
  if (is_new) builder.rest();
  spindle_ = direction;
  if (is_new || !surface_speed_) builder.mark({.speed = turns(direction) ? speed_ : 0, .kind = direction}, place);
  if (turns(direction) && surface_speed_) {
    builder.mark({.speed = *surface_speed_, .kind = MarkerKind::kSpindleSurfaceSpeed}, place);
  }
}

}  // namespace kcs::gcode
