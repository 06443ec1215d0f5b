// The plans that a server keeps for its caller, and how far those have come that it is still making.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "client/sdk/plan.h"

namespace kcs::client {

// A plan passes if it passes everything that is set.
struct PlanFilter {
  std::optional<std::string> machine_name;  // exactly
  std::optional<PlanState> state;           // kWaiting and kPlanning both stand for whatever is not yet made
  std::optional<Time> created_from;
  std::optional<Time> created_before;
  std::optional<double> cycle_time_at_least_s;  // plans without a summary do not pass
  std::optional<double> cycle_time_at_most_s;
};

// A part of a list, the latest plans first.
struct PlanPage {
  std::vector<Plan> plans;      // without their notices
  std::string next_page_token;  // for the next part; empty: this is the last one
};

struct PlanProgress {
  PlanState state = PlanState::kWaiting;
  std::uint32_t requests_ahead = 0;  // that are planned before this one; 0 once its turn has come
  std::uint64_t segment_count = 0;
  std::uint64_t segments_planned = 0;  // and verified
};

}  // namespace kcs::client
