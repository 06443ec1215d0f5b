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

float checked_speed(const Words& words) {
  const double speed = words.value('S');
  if (!(speed >= 0 && speed <= planning::range::kMaxSpindleSpeed)) {
    refuse(words.place('S'), "a spindle speed outside 0 to 1000000 per minute. M3 and M4 say which way it turns.");
  }
  return static_cast<float>(speed);
}

}  // namespace

void Switches::execute(const Words& words, const Codes& codes, PathBuilder& builder) {
  // Beside a word that was skipped S may be its own, such as a printer's fan (M106 S255).
  const bool has_speed = words.has('S') && (codes.has(Group::kSpindle) || !codes.has_skipped());
  if (has_speed) speed_ = checked_speed(words);
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

void Switches::stop_spindle(Place place, PathBuilder& builder) {
  if (turns(spindle_)) turn(MarkerKind::kSpindleOff, place, builder);
}

void Switches::stop_coolant(Place place, PathBuilder& builder) {
  if (!coolant_is_on_) return;
  coolant_is_on_ = false;
  builder.mark({.kind = MarkerKind::kCoolantOff}, place);
}

void Switches::turn(MarkerKind direction, Place place, PathBuilder& builder) {
  if (direction != spindle_) builder.rest();
  spindle_ = direction;
  builder.mark({.speed = turns(direction) ? speed_ : 0, .kind = direction}, place);
}

}  // namespace kcs::gcode
