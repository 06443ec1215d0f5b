#include "server/gcode/path_builder.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "server/gcode/cap_reached.h"
#include "server/gcode/trigonometry.h"
#include "server/planning/options.h"

namespace kcs::gcode {
namespace {

// Lines whose directions differ by less go straight on, rad.
constexpr double kStraight = 1e-9;

double angle_between(const Vector& a, const Vector& b) { return arc_tangent(a.cross(b).norm(), a.dot(b)); }

}  // namespace

PathBuilder::PathBuilder(const Vector& start, TakeSegment take, std::size_t max_segments, std::size_t max_chords)
    : take_(std::move(take)), last_start_(start), max_segments_(max_segments), max_chords_(max_chords) {}

void PathBuilder::line(const Vector& end, const Manner& manner) {
  if (end == position()) return;
  const bool is_exact = manner.tolerance == 0;
  rest_at_corner(end, 0, manner);
  append(end, is_exact ? kExactTolerance : manner.tolerance, manner);
  last_->stop = manner.rests;
  last_is_exact_ = is_exact;
  last_turn_ = 0;
}

void PathBuilder::arc(const Arc& arc, const Manner& manner) {
  if (arc.reach() > planning::range::kCoordinate) {
    refuse(manner.place, "the arc's circle reaches farther than 1e7 mm from zero. Write so flat an arc as a line.");
  }
  const bool is_exact = manner.tolerance == 0;
  const double chords = arc.chords_within(is_exact ? kExactTolerance : kChordShare * manner.tolerance);
  if (chords > static_cast<double>(max_chords_)) {
    throw CapReached({"max_chords", max_chords_}, manner.place,
                     "the arc needs more than " + std::to_string(max_chords_) +
                         " chords (the cap max_chords) to stay inside the tolerance. Use a larger tolerance "
                         "(G64 P), or fewer turns (P).");
  }
  const auto count = static_cast<std::size_t>(chords);
  const double turn = arc.sweep() / chords;
  rest_at_corner(arc.chord_end(1, count), turn, manner);
  for (std::size_t chord = 1; chord <= count; ++chord) {
    append(arc.chord_end(chord, count), is_exact ? kExactTolerance : (1 - kChordShare) * manner.tolerance, manner);
  }
  last_->stop = manner.rests;
  last_is_exact_ = is_exact;
  last_turn_ = turn;
  largest_chord_error_ = std::max(largest_chord_error_, arc.chord_error(chords));
}

void PathBuilder::rest() {
  if (last_) last_->stop = true;
}

void PathBuilder::dwell(double duration, Place place) {
  if (!last_) append_pause(place);
  last_->stop = true;
  last_->dwell += duration;
  if (last_->dwell > planning::range::kMaxDwell) {
    refuse(place, "the tool would stay here for more than 1e6 s. G4 P is in seconds.");
  }
}

void PathBuilder::mark(const planning::Marker& marker, Place place) {
  const bool is_free = last_ && last_->dwell == 0 && last_->marker.kind == planning::MarkerKind::kNone;
  if (!is_free) append_pause(place);
  last_->marker = marker;
}

void PathBuilder::finish() {
  if (last_) take_(*last_);
}

void PathBuilder::append(const Vector& end, double tolerance, const Manner& manner) {
  if (segments_ == max_segments_) {
    throw CapReached({"max_segments", max_segments_}, manner.place,
                     "the program has more than " + std::to_string(max_segments_) +
                         " segments (the cap max_segments). Split it into several programs.");
  }
  ++segments_;
  if (last_) {
    take_(*last_);
    if (end != last_->end) last_start_ = last_->end;
  }
  last_ = {.end = end, .feed = manner.feed, .tolerance = tolerance, .line = manner.place.line};
}

// A segment of no length: for what happens at the very start of the path, or one thing after the other at one place.
void PathBuilder::append_pause(Place place) {
  append(position(), 0, {.feed = std::numeric_limits<double>::infinity(), .place = place});
}

// Where a move is to be followed exactly, lets the tool rest before it, unless the path goes on smoothly. Where an arc
// meets a line or an arc tangentially, its chords still change direction: by less than they do among each other.
void PathBuilder::rest_at_corner(const Vector& first_end, double turn, const Manner& manner) {
  if (!last_ || (manner.tolerance > 0 && !last_is_exact_)) return;
  const double corner = angle_between(last_->end - last_start_, first_end - last_->end);
  if (corner > std::max({turn, last_turn_, kStraight})) last_->stop = true;
}

}  // namespace kcs::gcode
