// What can happen to a machine that runs.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/faults/chance.h"
#include "tests/faults/scene.h"

namespace kcs::faults {

struct Fault {
  std::string name;
  std::function<void(Scene&, Chance&)> happen;  // once, to a machine that moves, and over again
  bool scrambles = false;                       // batches on their way
  bool kills_gateway = false;                   // for drives that outlive it
};

std::vector<Fault> all_faults();

}  // namespace kcs::faults
