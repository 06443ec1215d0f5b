// How the programs write the names of things, and read them.
#pragma once

#include <array>
#include <string_view>

#include "client/sdk/plan.h"

namespace kcs::client {

inline constexpr std::array<std::string_view, 3> kAxisNames = {"X", "Y", "Z"};

constexpr std::string_view name_of(CornerStrategy strategy) {
  switch (strategy) {
    case CornerStrategy::kAuto:
      return "auto";
    case CornerStrategy::kInterrupted:
      return "interrupted";
    case CornerStrategy::kUninterrupted:
      return "uninterrupted";
    case CornerStrategy::kExactStop:
      return "exact-stop";
    case CornerStrategy::kBlended:
      return "blended";
    case CornerStrategy::kOverlapping:
      return "overlapping";
  }
  return "";
}

constexpr std::string_view name_of(ToleranceKind kind) {
  return kind == ToleranceKind::kCornerDistance ? "corner" : "contour";
}

}  // namespace kcs::client
