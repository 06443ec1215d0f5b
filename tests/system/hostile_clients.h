// What a kcsd must still be like after its clients did their worst.
#pragma once

#include <chrono>
#include <string>

#include "tests/system/test_kcsd.h"

namespace kcs::test {

class HostileClients : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(is_served()); }

  void TearDown() override {
    const auto began = std::chrono::steady_clock::now();
    EXPECT_TRUE(is_served());
    EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(5));
    EXPECT_TRUE(eventually([this] { return kcsd_.status_figure("Threads:") <= kMostThreads; }))
        << kcsd_.status_figure("Threads:") << " threads are left";
    EXPECT_LT(kcsd_.status_figure("VmHWM:"), kMostMemory) << "kB at the worst";
    const std::string log = kcsd_.process().errors();
    EXPECT_EQ(log.find("INTERNAL"), std::string::npos) << log.substr(log.find("INTERNAL") - 200, 1000);
    kcsd_.process().send_signal(SIGTERM);
    EXPECT_EQ(kcsd_.process().wait(), 0);
  }

  ::testing::AssertionResult is_served() {
    const auto plan = kcsd_.create(request_of(++number_));
    if (!plan.status.ok()) return ::testing::AssertionFailure() << plan.status.error_message();
    const auto streamed = kcsd_.stream(setpoints(plan.message.name(), 0.01));
    if (!streamed.status.ok()) return ::testing::AssertionFailure() << streamed.status.error_message();
    return ::testing::AssertionSuccess();
  }

  // An idle one has some twenty threads, a few more while gRPC keeps those that were busy.
  static constexpr std::size_t kMostThreads = 40;
  static constexpr std::size_t kMostMemory = 1'000'000;  // kB; a million points take 100 MB or so

  TestKcsd kcsd_{
      "[server]\ngrace_s = 1.0\n[store]\ndatabase = \"memory\"\n"
      "[connections]\nhandshake_s = 2.0\n"};

 private:
  std::uint64_t number_ = 0;
};

}  // namespace kcs::test
