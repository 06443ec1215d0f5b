#include "server/gcode/lengths.h"

#include <cmath>

#include "server/gcode/trigonometry.h"
#include "server/planning/options.h"

namespace kcs::gcode {

double length_of(const Words& words, char letter, double unit) {
  const double value = words.value(letter) * unit;
  if (std::abs(value) > planning::range::kCoordinate) {
    refuse(words.place(letter), "a length of more than 1e7 mm. Check the number and the units (G20, G21).");
  }
  return value;
}

Stated stated_by(const Words& words, double unit) {
  Stated stated;
  for (int axis = 0; axis < 3; ++axis) {
    const char letter = axis_letter(axis);
    if (words.has(letter)) stated[static_cast<std::size_t>(axis)] = length_of(words, letter, unit);
  }
  return stated;
}

Stated stated_move(const Words& words, double unit, bool incremental, const Vector& from) {
  Stated stated = stated_by(words, unit);
  if (!words.has_any(kPolar)) return stated;
  if (words.has_any(letters("XY"))) {
    refuse(words.first_of(kPolar), "a radius (@) or an angle (^) beside X or Y. Keep one or the other.");
  }
  double radius = from.head<2>().norm();
  double angle = degrees_of(arc_tangent(from.y(), from.x()));
  if (radius == 0 && (incremental || !words.has('^'))) {
    refuse(words.first_of(kPolar),
           "the tool is at the zero of X and Y, where it has no angle. Write @ and ^ under G90.");
  }
  if (words.has('@')) radius = length_of(words, '@', unit) + (incremental ? radius : 0);
  if (words.has('^')) angle = words.value('^') + (incremental ? angle : 0);
  const auto [sine, cosine] = sine_and_cosine_of_degrees(angle);
  stated[0] = radius * cosine - (incremental ? from.x() : 0);
  stated[1] = radius * sine - (incremental ? from.y() : 0);
  return stated;
}

}  // namespace kcs::gcode
