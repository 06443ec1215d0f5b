// What can happen to a machine that runs.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tests/faults/chance.h"
#include "tests/faults/scene.h"

namespace kcs::faults {

struct Fault {
  std::string name;
  std::function<void(Scene&, Chance&)> happen;  // once, to a machine that moves, and over again
  std::optional<double> reaction_s = {};        // half of all must be answered so soon by another pace
  bool stops_by_tail = true;                    // every stop is the tail of a batch
  bool scrambles = false;                       // batches on their way
  bool kills_gateway = false;                   // for drives that outlive it
  bool replicas = false;                        // of the server, behind a balancer
};

std::vector<Fault> all_faults();

}  // namespace kcs::faults
