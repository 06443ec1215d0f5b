// How many calls are let in, of all and of one client.
#include "server/service/gate.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>

namespace kcs::service {
namespace {

// The cap that is reached if the client comes now; empty if he is let in.
std::string obstacle(Gate& gate, const jobs::Client& client) {
  try {
    const Gate::Pass pass(gate, client);
    return "";
  } catch (const jobs::CapExceeded& refused) {
    EXPECT_EQ(refused.retry_after(), kGateRetry);
    return refused.cap();
  }
}

TEST(Gate, OneClientLeavesPlacesToOthers) {
  Gate gate({"uploads", 3}, {"client_uploads", 2});
  const Gate::Pass first(gate, "cam");
  std::optional<Gate::Pass> second(std::in_place, gate, "cam");
  EXPECT_EQ(obstacle(gate, "cam"), "client_uploads");
  EXPECT_EQ(obstacle(gate, "shop"), "");
  second.reset();
  EXPECT_EQ(obstacle(gate, "cam"), "");
}

TEST(Gate, FullForAllIsFullForEverybody) {
  Gate gate({"uploads", 2}, {"client_uploads", 2});
  const Gate::Pass first(gate, "cam");
  std::optional<Gate::Pass> second(std::in_place, gate, "shop");
  EXPECT_EQ(obstacle(gate, "cam"), "uploads");
  EXPECT_EQ(obstacle(gate, "another"), "uploads");
  second.reset();
  EXPECT_EQ(obstacle(gate, "another"), "");
}

}  // namespace
}  // namespace kcs::service
