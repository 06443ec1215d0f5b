// Corners as a table for people, 80 columns wide.
#pragma once

#include <string>
#include <vector>

#include "client/sdk/plan.h"

namespace kcs::cli {

std::string corners_table(const std::vector<client::Corner>& corners);

}  // namespace kcs::cli
