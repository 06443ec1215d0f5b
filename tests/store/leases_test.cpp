// Who plans what has been accepted, among several servers and after a restart.
#include <algorithm>
#include <thread>

#include "tests/store/store_test.h"

namespace kcs::store {
namespace {

constexpr std::size_t kMany = 1000;

class Planners : public StoreTest {
 protected:
  Planners() { settings_.lease = std::chrono::hours(1); }

  StoreSettings short_leases() const {
    StoreSettings settings = settings_;
    settings.lease = std::chrono::milliseconds(200);
    return settings;
  }

  // Claims until it has so many.
  static std::vector<std::string> eventually_claims(Store& store, std::size_t plans) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    std::vector<std::string> claimed;
    while (claimed.size() < plans && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      claimed = store.claim(kMany);
    }
    return claimed;
  }
};
KCS_ON_EACH_DATABASE(Planners);

TEST_P(Planners, OnlyTheServerThatAcceptedPlans) {
  Store first(settings_);
  Store second(settings_);
  EXPECT_TRUE(accept(first, "ada", 1).to_plan);
  EXPECT_FALSE(accept(second, "ada", 1).to_plan);
  EXPECT_FALSE(accept(second, "bob", 1).to_plan);
  EXPECT_FALSE(second.find("ada", plan_name(1))->to_plan);
  EXPECT_TRUE(first.find("ada", plan_name(1))->to_plan);
  EXPECT_FALSE(second.list("ada", {}, 1, "").records.front().to_plan);
  EXPECT_EQ(first.claim(kMany), std::vector{plan_name(1)});
  EXPECT_TRUE(second.claim(kMany).empty());
}

TEST_P(Planners, WhatHasAnOutcomeIsNobodysToPlan) {
  Store store(settings_);
  for (std::uint64_t number = 1; number <= 3; ++number) accept(store, "ada", number);
  store.finish(plan_name(1), {.plan = "plan", .cycle_time = 1});
  store.refuse(plan_name(2), "no");
  accept_finished(store, "ada", 4);
  EXPECT_EQ(store.claim(kMany), std::vector{plan_name(3)});
  store.remove("ada", plan_name(3));
  EXPECT_TRUE(store.claim(kMany).empty());
}

TEST_P(Planners, AServerThatDiedLosesItsPlansWhenItsLeaseEnds) {
  Store next(settings_);
  {
    Store dying(short_leases());
    accept(dying, "ada", 1);
    accept(dying, "ada", 2);
  }
  EXPECT_EQ(eventually_claims(next, 2), (std::vector{plan_name(1), plan_name(2)}));
  EXPECT_TRUE(next.find("ada", plan_name(1))->to_plan);
  EXPECT_EQ(next.request(plan_name(1)), "request");
}

TEST_P(Planners, AcceptingAgainTakesOverFromTheDead) {
  Store next(settings_);
  { accept(*std::make_unique<Store>(short_leases()), "ada", 1); }
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!accept(next, "ada", 1).to_plan && std::chrono::steady_clock::now() < end) {
  }
  EXPECT_TRUE(next.find("ada", plan_name(1))->to_plan);
}

TEST_P(Planners, ClaimingKeepsTheLeases) {
  settings_.lease = std::chrono::seconds(2);
  Store living(settings_);
  Store other(settings_);
  accept(living, "ada", 1);
  auto last = std::chrono::steady_clock::now();
  const auto end = last + settings_.lease * 3 / 2;
  while (last < end) {
    living.claim(kMany);
    const auto now = std::chrono::steady_clock::now();
    if (now - last > settings_.lease / 2) GTEST_SKIP() << "this machine is too busy to claim in time";
    last = now;
    ASSERT_TRUE(other.claim(kMany).empty());
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

TEST_P(Planners, ReleasedPlansAreTakenAtOnce) {
  Store first(settings_);
  Store second(settings_);
  accept(first, "ada", 1);
  accept(second, "ada", 2);
  first.release();
  EXPECT_FALSE(first.find("ada", plan_name(1))->to_plan);
  EXPECT_EQ(second.claim(kMany), (std::vector{plan_name(1), plan_name(2)}));
}

TEST_P(Planners, NoneTakesMoreThanItWants) {
  Store dead(settings_);
  for (std::uint64_t number = 1; number <= 5; ++number) {
    accept(dead, "ada", number);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  dead.release();
  Store first(settings_);
  Store second(settings_);
  EXPECT_EQ(first.claim(2), (std::vector{plan_name(1), plan_name(2)}));
  EXPECT_EQ(first.claim(2), (std::vector{plan_name(1), plan_name(2)}));
  EXPECT_TRUE(second.claim(0).empty());
  EXPECT_EQ(second.claim(kMany), (std::vector{plan_name(3), plan_name(4), plan_name(5)}));
  EXPECT_EQ(first.claim(0), (std::vector{plan_name(1), plan_name(2)}));
}

TEST_P(Planners, EachPlanIsTakenByOneOfManyAtTheSameMoment) {
  constexpr std::uint64_t kPlans = 40;
  {
    Store dead(settings_);
    for (std::uint64_t number = 1; number <= kPlans; ++number) accept(dead, "ada", number);
    dead.release();
  }
  std::vector<std::vector<std::string>> taken(4);
  std::vector<std::thread> servers;
  for (auto& mine : taken) {
    servers.emplace_back([&] {
      Store store(settings_);
      for (std::size_t most = 5; most <= kPlans; most += 5) mine = store.claim(most);
    });
  }
  for (std::thread& server : servers) server.join();
  std::vector<std::string> all;
  for (const auto& mine : taken) all.insert(all.end(), mine.begin(), mine.end());
  std::ranges::sort(all);
  EXPECT_EQ(all.size(), kPlans);
  EXPECT_TRUE(std::ranges::adjacent_find(all) == all.end());
}

}  // namespace
}  // namespace kcs::store
