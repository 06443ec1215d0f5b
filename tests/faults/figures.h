// How soon a machine reacted, and how long it took to stop: out of what its drives were commanded.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "server/motion/limits.h"
#include "tests/faults/judge.h"

namespace kcs::faults {

struct Figures {
  std::size_t instants = 0;       // at which it moved
  std::vector<double> reactions;  // s, from an instant to the first command that was not the planned pace any more, in
                                  // ascending order; of those at which it was the planned pace
  std::size_t stops = 0;
  std::vector<double>
      stop_times;  // s, from the first such command to rest, in ascending order; of stops from that pace
  // How much longer one of them took than the tail that the plan has for its place, s; ≤ 0: none did.
  double longest_beyond_tail = 0;
};

// instants: when something was done to it, on the clock of the drives, in ascending order.
Figures measure(const Commands& commands, const Verdict& verdict, const std::vector<double>& instants,
                const motion::AxisLimits& limits, double period);

// Of numbers in ascending order; nothing if there are none.
std::optional<double> median(const std::vector<double>& sorted);

}  // namespace kcs::faults
