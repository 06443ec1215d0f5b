#include "server/gcode/modes.h"

#include <string>

#include "server/planning/options.h"

namespace kcs::gcode {
namespace {

constexpr double kMillimetresPerInch = 25.4;

}  // namespace

void Modes::apply(const Words& words, const Codes& codes, const Options& options) {
  if (codes.has(Group::kUnits)) unit = codes[Group::kUnits] == code(20) ? kMillimetresPerInch : 1;
  // A feed that is replaced anyway need not be right.
  if (!options.feed) apply_feed(words, codes);
  if (codes.has(Group::kMotion)) apply_motion(codes[Group::kMotion]);
  if (codes.has(Group::kPlane)) apply_plane(codes[Group::kPlane]);
  if (codes.has(Group::kDistance)) incremental = codes[Group::kDistance] == code(91);
  if (codes.has(Group::kArcCentres)) absolute_centres = codes[Group::kArcCentres] == code(90, 1);
  if (codes.has(Group::kRetract)) retracts_to_r = codes[Group::kRetract] == code(99);
  if (codes.has(Group::kPathControl)) apply_path_control(words, codes[Group::kPathControl], options.tolerance);
}

void Modes::apply_feed(const Words& words, const Codes& codes) {
  if (codes.has(Group::kFeedMode)) {
    const bool was_inverse_time = inverse_time;
    inverse_time = codes[Group::kFeedMode] == code(93);
    // A feed of the other mode would be a number of another unit.
    if (inverse_time != was_inverse_time) feed = 0;
  }
  if (!words.has('F')) return;
  const double value = words.value('F');
  if (value < 0) refuse(words.place('F'), "a feed below zero. Write the feed without a sign.");
  if (inverse_time) return;
  // F0 takes the feed away; the next move needs a new one.
  feed = value == 0 ? 0 : checked_feed(value * unit / 60, words.place('F'));
}

void Modes::apply_motion(int word) {
  switch (word) {
    case code(0):
      motion = Motion::kRapid;
      break;
    case code(1):
      motion = Motion::kLine;
      break;
    case code(2):
      motion = Motion::kClockwiseArc;
      break;
    case code(3):
      motion = Motion::kCounterclockwiseArc;
      break;
    case code(80):
      motion = Motion::kNone;
      break;
    default:  // G73 and G81 to G89
      motion = Motion::kCycle;
      cycle = word;
      break;
  }
}

void Modes::apply_plane(int word) {
  switch (word) {
    case code(18):
      plane = kPlaneZx;
      break;
    case code(19):
      plane = kPlaneYz;
      break;
    default:  // G17
      plane = kPlaneXy;
      break;
  }
}

void Modes::apply_path_control(const Words& words, int word, double usual_tolerance) {
  rests_after_every_move = word == code(61, 1);
  if (word != code(64)) {
    tolerance = 0;
  } else if (words.has('P')) {
    tolerance = words.value('P') * unit;
    if (tolerance < 0 || tolerance > planning::range::kMaxTolerance) {
      refuse(words.place('P'), "the tolerance of G64 P must be from 0 to 1000 mm.");
    }
  } else {
    tolerance = usual_tolerance;
  }
}

double checked_feed(double feed, Place place) {
  if (feed >= planning::range::kMinFeed && feed <= planning::range::kMaxFeed) return feed;
  refuse(place,
         "a feed of " + std::to_string(feed) +
             " mm/s. It must be from 1e-6 to 1e6 mm/s; F is in mm/min (G21) or inches/min (G20), with G93 in 1/min.");
}

}  // namespace kcs::gcode
