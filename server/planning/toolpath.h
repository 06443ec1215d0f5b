// What is to be moved along: straight segments with what the program says about each.
#pragma once

#include <cstdint>
#include <vector>

#include "server/motion/phase.h"
#include "server/planning/marker.h"

namespace kcs::planning {

using motion::Vector;

// A straight move from the end of the segment before it (or the start of the path).
struct Segment {
  Vector end = Vector::Zero();  // mm
  double feed = 0;              // mm/s along the path, > 0; +infinity: as fast as the axes' velocity limits allow
  double tolerance = 0;         // mm, ≥ 0, at its corners; a corner keeps the smaller one of its two segments'
  double dwell = 0;             // s, ≥ 0; how long the tool stays at the end; more than 0 implies `stop`
  std::uint32_t line = 0;       // of the program, from 1; 0: not known
  bool stop = false;            // the tool comes to rest on the end exactly
  Marker marker;                // what is switched when the tool comes to the end, before it dwells there
};

// What is nearer than this to the point before it, mm, does not move: no machine resolves a picometre.
inline constexpr double kNoLength = 1e-9;

// How a tool path begins and ends.
struct PathEnds {
  Vector start = Vector::Zero();  // mm
  // How the tool moves there, along the first segment that moves: at rest unless said, or it goes on from another
  // motion.
  double start_speed = 0;         // mm/s, ≥ 0
  double start_acceleration = 0;  // mm/s²
  double end_speed = 0;           // mm/s, ≥ 0: at the end, along the last segment; 0: rest
};

// Segments of no length are allowed; their stops, dwells and markers count, but they are not counted as segments.
struct Toolpath : PathEnds {
  std::vector<Segment> segments;

  const Vector& start_of(std::size_t segment) const { return segment == 0 ? start : segments[segment - 1].end; }
};

}  // namespace kcs::planning
