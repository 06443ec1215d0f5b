// Who is calling.
#pragma once

#include <string>

#include "server/security/role.h"

namespace kcs::security {

struct Identity {
  std::string owner;  // of the plans that the caller makes; empty where nobody is told apart
  Roles roles;

  bool is_admin() const { return roles.include({Role::kAdmin}); }
};

// The caller of a server that tells nobody apart.
inline Identity anybody() { return {.owner = "", .roles = {Role::kAdmin}}; }

}  // namespace kcs::security
