// How the programs write the names of things, and read them.
#pragma once

#include <array>
#include <string_view>

#include "client/sdk/plan.h"
#include "client/sdk/run.h"

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

constexpr std::string_view name_of(RunState state) {
  switch (state) {
    case RunState::kWaiting:
      return "waiting";
    case RunState::kRunning:
      return "running";
    case RunState::kStopping:
      return "stopping";
    case RunState::kHeld:
      return "held";
    case RunState::kFinished:
      return "finished";
    case RunState::kAborted:
      return "aborted";
    case RunState::kFailed:
      return "failed";
  }
  return "";
}

constexpr std::string_view name_of(MachineState state) {
  switch (state) {
    case MachineState::kUnknown:
      return "not attached";
    case MachineState::kSwitchedOff:
      return "switched off";
    case MachineState::kReady:
      return "ready";
    case MachineState::kRunning:
      return "running";
    case MachineState::kStopping:
      return "stopping";
    case MachineState::kHeld:
      return "held";
    case MachineState::kFault:
      return "fault";
  }
  return "";
}

}  // namespace kcs::client
