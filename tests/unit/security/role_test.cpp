// Roles, by name and in sets.
#include "server/security/role.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "server/security/identity.h"

namespace kcs::security {
namespace {

TEST(Role, IsFoundByItsName) {
  EXPECT_EQ(role_named("plan"), Role::kPlan);
  EXPECT_EQ(role_named("stream"), Role::kStream);
  EXPECT_EQ(role_named("machine"), Role::kMachine);
  EXPECT_EQ(role_named("admin"), Role::kAdmin);
  for (const std::string name : {"", "Plan", "plans", "root"})
    EXPECT_THROW(role_named(name), std::runtime_error) << name;
}

TEST(Roles, IncludeWhatWasAdded) {
  const Roles none;
  const Roles both = {Role::kPlan, Role::kStream};
  EXPECT_TRUE(both.include({Role::kPlan}));
  EXPECT_TRUE(both.include(both));
  EXPECT_TRUE(both.include(none));
  EXPECT_FALSE(none.include({Role::kPlan}));
  EXPECT_FALSE(both.include({Role::kPlan, Role::kMachine}));
  EXPECT_EQ(names_of(both), "plan and stream");
}

TEST(Identity, OfAnybodyIsAnAdministratorWithoutAName) {
  EXPECT_TRUE(anybody().is_admin());
  EXPECT_EQ(anybody().owner, "");
}

}  // namespace
}  // namespace kcs::security
