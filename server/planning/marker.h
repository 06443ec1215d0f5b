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
};

struct Marker {
  float speed = 0;  // of the spindle where it turns, 1/min, ≥ 0; finer than any spindle keeps it, and half the memory
  MarkerKind kind = MarkerKind::kNone;

  bool operator==(const Marker&) const = default;
};

struct MarkerAt {
  double time = 0;  // s, since the start of the plan
  Marker marker;
};

}  // namespace kcs::planning
