// Machines and their runs for other programs.
#pragma once

#include <string>
#include <vector>

#include "client/sdk/run.h"

namespace kcs::cli {

// One object in one line.
std::string run_json(const client::Run& run);

// One object a line.
std::string machines_json(const std::vector<client::AttachedMachine>& machines);

}  // namespace kcs::cli
