// Who a token or a certificate stands for.
#include "server/security/callers.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace kcs::security {
namespace {

TEST(Callers, AreFoundByTheirTokenAlone) {
  const std::vector<KnownToken> known = {{TokenHash::of("the token of the CAM"), {"cam", {Role::kPlan}}},
                                         {TokenHash::of("the token of the shop"), {"shop", {Role::kStream}}}};
  ASSERT_NE(find_caller(known, "the token of the CAM"), nullptr);
  EXPECT_EQ(find_caller(known, "the token of the CAM")->owner, "cam");
  EXPECT_EQ(find_caller(known, "the token of the shop")->owner, "shop");
  EXPECT_EQ(find_caller(known, "the token of the sho"), nullptr);
  EXPECT_EQ(find_caller(known, ""), nullptr);
  // Whoever has read the configuration has no token by that.
  EXPECT_EQ(find_caller(known, known[0].hash.text()), nullptr);
}

TEST(Callers, AreFoundByOneOfTheirNames) {
  const std::vector<KnownCertificate> known = {{"gateway-1.example.com", {"gateway", {Role::kStream}}}};
  EXPECT_EQ(find_caller(known, {"10.0.0.1", "gateway-1.example.com"}), &known[0].caller);
  EXPECT_EQ(find_caller(known, {"gateway-1.example.com.attacker.org", "gateway-1"}), nullptr);
  EXPECT_EQ(find_caller(known, {}), nullptr);
}

}  // namespace
}  // namespace kcs::security
