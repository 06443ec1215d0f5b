// How kcsctl writes the names of things.
#pragma once

#include <array>
#include <string_view>

#include "client/sdk/plan.h"

namespace kcs::cli {

inline constexpr std::array<std::string_view, 3> kAxisNames = {"X", "Y", "Z"};

constexpr std::string_view name_of(client::CornerStrategy strategy) {
  switch (strategy) {
    case client::CornerStrategy::kAuto:
      return "auto";
    case client::CornerStrategy::kInterrupted:
      return "interrupted";
    case client::CornerStrategy::kUninterrupted:
      return "uninterrupted";
    case client::CornerStrategy::kExactStop:
      return "exact-stop";
  }
  return "";
}

constexpr std::string_view name_of(client::ToleranceKind kind) {
  return kind == client::ToleranceKind::kCornerDistance ? "corner" : "contour";
}

}  // namespace kcs::cli
