// A plan as a table for people, at most 80 columns wide.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "client/sdk/plan.h"

namespace kcs::cli {

// `program` is the program's name. The corners are those of the plan.
std::string plan_table(std::string_view program, const client::Plan& plan, const std::vector<client::Corner>& corners);

}  // namespace kcs::cli
