// Plans and corners as JSON. The keys are the field names of proto/kcs/v1/planning.proto.
#pragma once

#include <string>
#include <vector>

#include "client/sdk/plan.h"

namespace kcs::cli {

// One object: the summary's fields, and the plan's name, options and notices.
std::string plan_json(const client::Plan& plan);

// An array with one object per corner, a line each.
std::string corners_json(const std::vector<client::Corner>& corners);

}  // namespace kcs::cli
