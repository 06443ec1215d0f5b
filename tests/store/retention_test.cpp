// What is forgotten: by age, by size.
#include <thread>

#include "tests/store/store_test.h"

namespace kcs::store {
namespace {

class Retention : public StoreTest {
 protected:
  StoreSettings keeping(std::chrono::seconds age) const {
    StoreSettings settings = settings_;
    settings.keep = age;
    return settings;
  }

  StoreSettings keeping(std::uint64_t bytes) const {
    StoreSettings settings = settings_;
    settings.keep_bytes = bytes;
    return settings;
  }
};
KCS_ON_EACH_DATABASE(Retention);

void let_time_pass() { std::this_thread::sleep_for(std::chrono::milliseconds(2)); }

// A plan of about 100 kB.
void keep_large(Store& store, const std::string& owner, std::uint64_t number) {
  std::string bytes = some_bytes(number, 100'000);
  for (std::size_t i = 0; i < bytes.size(); i += 2) bytes[i] = bytes[bytes.size() - 1 - i];  // so that all of it counts
  store.accept_finished(owner, {.name = plan_name(number), .machine_name = "mill", .bytes = bytes}, {.plan = "plan"});
  let_time_pass();
}

TEST_P(Retention, KeepsWhatIsYoungAndFits) {
  Store store(settings_);
  accept_finished(store, "ada", 1);
  EXPECT_TRUE(store.sweep().empty());
  EXPECT_TRUE(store.find("ada", plan_name(1)));
}

TEST_P(Retention, ForgetsWhatIsOldExceptWhatWaits) {
  Store store(keeping(std::chrono::seconds(3)));
  accept_finished(store, "ada", 1);
  accept_finished(store, "bob", 1);
  accept(store, "ada", 2);
  accept(store, "ada", 3);
  store.refuse(plan_name(3), "no");
  std::this_thread::sleep_for(std::chrono::milliseconds(3100));
  accept_finished(store, "ada", 4);
  EXPECT_EQ(store.sweep(), (std::vector{plan_name(1), plan_name(3)}));
  EXPECT_TRUE(store.sweep().empty());
  EXPECT_FALSE(store.find("ada", plan_name(1)));
  EXPECT_FALSE(store.find("bob", plan_name(1)));
  EXPECT_FALSE(store.request(plan_name(1)));
  EXPECT_TRUE(store.find("ada", plan_name(2)));
  EXPECT_TRUE(store.find("ada", plan_name(4)));
}

TEST_P(Retention, WhatIsUsedDoesNotGrowOld) {
  Store store(keeping(std::chrono::seconds(4)));
  accept_finished(store, "ada", 1);
  accept_finished(store, "ada", 2);
  const auto begin = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() < begin + std::chrono::milliseconds(4200)) {
    ASSERT_TRUE(store.find("ada", plan_name(1)));
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_EQ(store.sweep(), std::vector{plan_name(2)});
  EXPECT_TRUE(store.find("ada", plan_name(1)));
}

TEST_P(Retention, ForgetsTheOldestOfWhatIsTooMuch) {
  Store store(keeping(450'000));
  for (std::uint64_t number = 1; number <= 4; ++number) keep_large(store, "ada", number);
  EXPECT_TRUE(store.sweep().empty());
  keep_large(store, "bob", 1);  // is used again
  keep_large(store, "ada", 5);
  keep_large(store, "ada", 6);
  EXPECT_EQ(store.sweep(), (std::vector{plan_name(2), plan_name(3)}));
  EXPECT_TRUE(store.sweep().empty());
  for (const std::uint64_t number : {1, 4, 5, 6}) EXPECT_TRUE(store.find("ada", plan_name(number))) << number;
}

TEST_P(Retention, NeverForgetsWhatWaitsHoweverMuchItIs) {
  Store store(keeping(1));
  accept(store, "ada", 1, some_bytes(1, 1'000'000));
  EXPECT_TRUE(store.sweep().empty());
  EXPECT_EQ(store.request(plan_name(1))->size(), 1'000'000);
  store.finish(plan_name(1), {.plan = "plan", .cycle_time = 1});
  EXPECT_EQ(store.sweep(), std::vector{plan_name(1)});
}

TEST_P(Retention, ServersThatSweepTogetherForgetEachPlanOnce) {
  {
    Store store(settings_);
    for (std::uint64_t number = 1; number <= 30; ++number) accept_finished(store, "ada", number);
  }
  std::vector<std::vector<std::string>> forgotten(3);
  std::vector<std::thread> servers;
  for (auto& mine : forgotten) {
    servers.emplace_back([&] {
      Store store(keeping(1));
      mine = store.sweep();
    });
  }
  for (std::thread& server : servers) server.join();
  EXPECT_EQ(forgotten[0].size() + forgotten[1].size() + forgotten[2].size(), 30);
}

TEST(SqliteFile, ShrinksWhenPlansAreForgotten) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "state/plans.db";
  StoreSettings settings = new_database(Kind::kSqlite, folder);
  settings.keep_bytes = 1;
  {
    Store store(settings);
    accept(store, "ada", 1, some_bytes(1, 20'000'000));
    store.finish(plan_name(1), {.plan = "plan"});
  }
  EXPECT_GT(std::filesystem::file_size(file), 10'000'000);
  { EXPECT_EQ(Store(settings).sweep().size(), 1); }
  EXPECT_LT(std::filesystem::file_size(file), 200'000);
}

}  // namespace
}  // namespace kcs::store
