#include "server/gcode/lengths.h"

#include <cmath>

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

}  // namespace kcs::gcode
