#include "server/observe/readiness.h"

#include <gtest/gtest.h>

#include <vector>

namespace kcs::observe {
namespace {

TEST(Readiness, IsNotThereAtFirstAndSaysWhy) {
  const Readiness readiness;
  EXPECT_EQ(readiness.obstacle(), "the server is starting");
}

TEST(Readiness, ComesAndGoes) {
  Readiness readiness;
  std::vector<bool> seen;
  readiness.watch([&seen](bool ready) { seen.push_back(ready); });
  readiness.set_ready();
  EXPECT_EQ(readiness.obstacle(), "");
  readiness.set_not_ready("the store is away");
  EXPECT_EQ(readiness.obstacle(), "the store is away");
  readiness.set_ready();
  EXPECT_EQ(seen, (std::vector<bool>{false, true, false, true}));
}

TEST(Readiness, EndsForGood) {
  Readiness readiness;
  std::vector<bool> seen;
  readiness.set_ready();
  readiness.watch([&seen](bool ready) { seen.push_back(ready); });
  readiness.stop();
  readiness.set_ready();
  readiness.set_not_ready("the store is away");
  EXPECT_EQ(readiness.obstacle(), "the server is stopping");
  EXPECT_EQ(seen, (std::vector<bool>{true, false}));
}

}  // namespace
}  // namespace kcs::observe
