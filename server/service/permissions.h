// Which role each method needs.
#pragma once

#include <string_view>

#include "server/security/identity.h"

namespace kcs::service {

// Throws Forbidden, with the roles that are missing, if `caller` may not call this method of kcs.v1.PlanningService.
// Health and reflection are for everybody.
void require_permission(const security::Identity& caller, std::string_view method);

}  // namespace kcs::service
