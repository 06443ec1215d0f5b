// The machines of a server for people.
#pragma once

#include <string>
#include <vector>

#include "client/sdk/run.h"

namespace kcs::cli {

// One row a machine, a second one for what is wrong with it; a sentence if there is none.
std::string machines_table(const std::vector<client::AttachedMachine>& machines);

}  // namespace kcs::cli
