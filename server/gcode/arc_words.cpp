#include "server/gcode/arc_words.h"

#include <cmath>
#include <string>

#include "server/gcode/lengths.h"

namespace kcs::gcode {
namespace {

constexpr double kMaxTurns = 1e6;
constexpr double kSmallestShortfall = 1e-6;  // mm, of a radius, that is worth a notice

int turns_of(const Words& words) {
  if (!words.has('P')) return 1;
  const double turns = words.value('P');
  if (turns < 1 || turns > kMaxTurns || turns != std::floor(turns)) {
    refuse(words.place('P'), "P of an arc counts its turns: a whole number from 1 to 1000000.");
  }
  return static_cast<int>(turns);
}

char centre_letter(int axis) { return static_cast<char>('I' + axis); }

// The centre of the block's arc in its plane, in machine coordinates.
Eigen::Vector2d centre_of(const Words& words, const Modes& modes, const Coordinates& coordinates, const Vector& start) {
  const Plane& plane = modes.plane;
  const char first = centre_letter(plane.first);
  const char second = centre_letter(plane.second);
  const char normal = centre_letter(plane.normal);
  const std::string both = std::string(1, first) + " and " + second;
  if (words.has(normal) && words.value(normal) != 0) {
    refuse(words.place(normal), "the arc's plane has no " + std::string(1, normal) + ": it takes " + both +
                                    ". Choose the plane with G17, G18 or G19.");
  }
  const int given = words.has(first) + words.has(second);
  if (given == 0 || (given == 1 && modes.absolute_centres)) {
    refuse(words.start(), "the arc's centre is missing. Write " + both +
                              (modes.absolute_centres ? " (G90.1 needs both)." : ", or the radius R."));
  }
  Vector stated = Vector::Zero();
  for (const int axis : {plane.first, plane.second}) {
    if (words.has(centre_letter(axis))) stated[axis] = length_of(words, centre_letter(axis), modes.unit);
  }
  return plane.of(modes.absolute_centres ? coordinates.to_machine(stated) : start + coordinates.turned(stated));
}

void note_mismatch(const Arc& arc, Place place, Notices& notices) {
  if (!arc.has_mismatch()) return;
  notices.add({'I'}, place.line, [&] {
    return "An arc starts " + std::to_string(arc.start_radius()) + " mm from its centre and ends " +
           std::to_string(arc.end_radius()) + " mm from it: the radius changes steadily. Check I, J and K.";
  });
}

void note_shortfall(const Arc& arc, double radius, Place place, Notices& notices) {
  const double shortfall = arc.start_radius() - std::abs(radius);
  if (shortfall < kSmallestShortfall) return;
  notices.add({'r'}, place.line, [&] {
    return "An arc's end is farther from its start than twice its radius R. Up to 0.001 mm too little radius counts "
           "as rounding: it was taken as half a circle of radius " +
           std::to_string(arc.start_radius()) + " mm.";
  });
}

}  // namespace

Arc arc_of(const Words& words, const Modes& modes, const Coordinates& coordinates, const Vector& start,
           const Vector& end, Notices& notices) {
  if (coordinates.is_turned() && modes.plane.normal != kPlaneXy.normal) {
    refuse(words.start(),
           "an arc in a plane with Z (G18, G19) under a work offset that is turned (G10 L2 R). Write it as lines.");
  }
  const Turn turn = modes.motion == Motion::kClockwiseArc ? Turn::kClockwise : Turn::kCounterclockwise;
  if (!words.has('R')) {
    Arc arc = Arc::about_centre(start, end, centre_of(words, modes, coordinates, start), modes.plane, turn,
                                turns_of(words), words.start());
    note_mismatch(arc, words.start(), notices);
    return arc;
  }
  if (words.has_any(kCentre)) {
    refuse(words.place('R'), "an arc with a radius (R) and a centre (I, J, K). Keep one of them.");
  }
  const double radius = length_of(words, 'R', modes.unit);
  Arc arc = Arc::of_radius(start, end, radius, modes.plane, turn, turns_of(words), words.place('R'));
  note_mismatch(arc, words.start(), notices);
  note_shortfall(arc, radius, words.place('R'), notices);
  return arc;
}

}  // namespace kcs::gcode
