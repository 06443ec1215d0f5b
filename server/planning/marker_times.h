// When a motion comes to the places where something is switched.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "server/motion/phase.h"
#include "server/planning/marker.h"
#include "server/planning/toolpath.h"

namespace kcs::planning {

// Takes the path and the motion along it, both in order, and gives the path's markers and the beginnings and ends of
// its dwells, in order, each at its time. Where the tool rests, that is when it has come to rest, and as long after
// that as it dwells before the marker. Where it goes on, that is when it passes the plane through the place that halves
// the angle of the path: the middle of a corner that is cut. It has to pass the corners before, one after the other: a
// place behind a sharp one may look passed from before it. Memory: that of the markers and corners ahead of the motion.
class MarkerTimes {
 public:
  // The next segment, which starts at `from` (mm); moves: it has a length.
  void add(const Segment& segment, const Vector& from, bool moves);
  // Nothing more comes of the path.
  void end_path();

  // The next phase. The path must have come as far as the phase follows it, and to the segment beyond. Returns what is
  // due until it ends; valid until the next call.
  const std::vector<MarkerAt>& follow(const motion::Phase& phase);
  // After the last phase, which ends at `time` (s). Returns the rest.
  const std::vector<MarkerAt>& finish(double time);

  // How many were not given yet.
  std::size_t waiting() const { return waiting_; }

 private:
  struct Item {
    double rest = 0;  // s, that the tool rests at the place before
    Marker marker;
  };
  struct Place {
    std::uint32_t segments = 0;      // that move and come before it
    Vector point = Vector::Zero();   // mm
    Vector before = Vector::Zero();  // directions of the path; zero where it has none
    Vector after = Vector::Zero();
    bool stops = false;
    double dwell = 0;  // s
    std::vector<Item> items;
  };

  void put(const Marker& marker);
  void give(double time);
  std::optional<double> arrival(const Place& place, const motion::Phase& phase) const;

  std::deque<Place> places_;  // with markers, or corners
  Place here_;                // where the path has come to
  // Of the path at the last corner that was kept.
  Vector direction_ = Vector::Zero();
  double passed_ = 0;  // when the tool came to the last place, s
  std::size_t waiting_ = 0;
  double last_ = 0;  // s, of those that were given
  std::vector<MarkerAt> given_;
};

}  // namespace kcs::planning
