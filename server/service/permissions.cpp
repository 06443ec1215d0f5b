#include "server/service/permissions.h"

#include <spdlog/fmt/fmt.h>

#include <array>
#include <stdexcept>
#include <string>

#include "server/service/status.h"

namespace kcs::service {
namespace {

using security::Role;

struct Permission {
  std::string_view method;
  security::Roles roles;
};

// All roles of one of a method's lines are needed. Whoever plays plans has to read what they are, too.
constexpr std::array<Permission, 18> kPermissions = {{{"CreatePlan", {Role::kPlan}},
                                                      {"GetPlan", {Role::kPlan}},
                                                      {"GetPlan", {Role::kStream}},
                                                      {"ListPlans", {Role::kPlan}},
                                                      {"WatchPlan", {Role::kPlan}},
                                                      {"DeletePlan", {Role::kPlan}},
                                                      {"DescribeCorners", {Role::kPlan}},
                                                      {"StreamSetpoints", {Role::kStream}},
                                                      {"PlanLive", {Role::kPlan, Role::kStream}},
                                                      {"AttachMachine", {Role::kMachine}},
                                                      {"ListMachines", {Role::kMachine}},
                                                      {"RunPlan", {Role::kMachine}},
                                                      {"GetRun", {Role::kMachine}},
                                                      {"HoldRun", {Role::kMachine}},
                                                      {"ResumeRun", {Role::kMachine}},
                                                      {"AbortRun", {Role::kMachine}},
                                                      {"SetFeedOverride", {Role::kMachine}},
                                                      {"WatchRun", {Role::kMachine}}}};

}  // namespace

void require_permission(const security::Identity& caller, std::string_view method) {
  if (caller.is_admin()) return;
  std::string wanted;
  for (const Permission& permission : kPermissions) {
    if (permission.method != method) continue;
    if (caller.roles.include(permission.roles)) return;
    wanted += (wanted.empty() ? "" : ", or ") + security::names_of(permission.roles);
  }
  throw Forbidden(fmt::format("{} needs the role {}; {} has {}: ask the server's operator for it", method,
                              wanted.empty() ? "admin" : wanted, caller.owner, security::names_of(caller.roles)));
}

}  // namespace kcs::service
