// Turns moves into the segments of a tool path: lines as they are, arcs as chords.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

#include "server/gcode/arc.h"
#include "server/gcode/place.h"
#include "server/planning/toolpath.h"

namespace kcs::gcode {

// The share of the tolerance that the chords of an arc may use up. Its segments carry the rest, so that chords and
// smoothing together stay inside the tolerance.
inline constexpr double kChordShare = 0.1;

// How far, in mm, chords may lie from their arc, and smoothing from the chords, where the path is to be followed
// exactly: with no room at all the tool would stop at every chord.
inline constexpr double kExactTolerance = 0.001;

// How the tool is to take a move.
struct Manner {
  double feed = 0;       // mm/s along the path
  double tolerance = 0;  // mm; 0: exactly, with a rest wherever the path has a corner
  bool rests = false;    // at the end of the move, in any case
  Place place;           // that the move comes from
};

// Takes a path segment by segment. What it throws ends the reading.
using TakeSegment = std::function<void(const planning::Segment&)>;

class PathBuilder {
 public:
  // start: where the tool is, mm. `take` gets each segment when the next one comes, for until then the tool may be told
  // to rest at its end. max_segments: cap on their number; max_chords: on one arc.
  PathBuilder(const Vector& start, TakeSegment take, std::size_t max_segments, std::size_t max_chords);

  // Where the tool is, mm.
  const Vector& position() const { return last_ ? last_->end : last_start_; }

  // Moves straight. A move to where the tool already is leaves no trace.
  void line(const Vector& end, const Manner& manner);
  // Moves along `arc`, which starts at position().
  void arc(const Arc& arc, const Manner& manner);
  // Comes to rest where the tool is.
  void rest();
  // Stays where the tool is for `duration` s, > 0.
  void dwell(double duration, Place place);
  // Switches something where the tool is, after what it did there before.
  void mark(const planning::Marker& marker, Place place);
  // Nothing more comes.
  void finish();

  // Largest distance between an arc and its chords so far, mm.
  double largest_chord_error() const { return largest_chord_error_; }

 private:
  void append(const Vector& end, double tolerance, const Manner& manner);
  void append_pause(Place place);
  void rest_at_corner(const Vector& first_end, double turn, const Manner& manner);

  TakeSegment take_;
  std::optional<planning::Segment> last_;
  Vector last_start_;  // of it, or if it does not move of the one before it; or where the path starts, mm
  std::size_t segments_ = 0;
  std::size_t max_segments_;
  std::size_t max_chords_;
  bool last_is_exact_ = false;  // the last move
  double last_turn_ = 0;        // by how much its chords change direction, rad; 0 for a line
  double largest_chord_error_ = 0;
};

}  // namespace kcs::gcode
