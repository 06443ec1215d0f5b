// What is switched at a place of the path.
#pragma once

#include <cstdint>

namespace kcs::planning {

// Numbered as in the contract.
enum class MarkerKind : std::uint8_t {
  kNone,
  kSpindleClockwise,         // M3
  kSpindleCounterclockwise,  // M4
  kSpindleOff,               // M5
  kMistOn,                   // M7
  kFloodOn,                  // M8
  kCoolantOff,               // M9
  kDwellBegins,
  kDwellEnds,
  kSpindleSpeedLimit,    // D of G96
  kSpindleSurfaceSpeed,  // G96, S
};

struct Marker {
  // Of the spindle, ≥ 0: 1/min, a surface speed m/min. Finer than any spindle keeps it, and half the memory.
  float speed = 0;
  MarkerKind kind = MarkerKind::kNone;

  bool operator==(const Marker&) const = default;
};

struct MarkerAt {
  double time = 0;  // s, since the start of the plan
  Marker marker;
};

}  // namespace kcs::planning
