#include "server/security/role.h"

#include <array>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace kcs::security {
namespace {

constexpr std::array<std::pair<Role, std::string_view>, 4> kNames = {
    {{Role::kPlan, "plan"}, {Role::kStream, "stream"}, {Role::kMachine, "machine"}, {Role::kAdmin, "admin"}}};

}  // namespace

Role role_named(const std::string& name) {
  for (const auto& [role, role_name] : kNames) {
    if (name == role_name) return role;
  }
  throw std::runtime_error("\"" + name + "\" is no role: use plan, stream, machine or admin");
}

std::string names_of(Roles roles) {
  std::string names;
  for (const auto& [role, name] : kNames) {
    if (roles.include({role})) names += (names.empty() ? "" : " and ") + std::string(name);
  }
  return names;
}

}  // namespace kcs::security
