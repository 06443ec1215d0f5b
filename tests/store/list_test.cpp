// Lists of plans: filters, order, pages.
#include <cmath>
#include <set>
#include <thread>

#include "tests/store/store_test.h"

namespace kcs::store {
namespace {

using Listing = StoreTest;
KCS_ON_EACH_DATABASE(Listing);

// Creation times are as fine as the clock; this keeps them apart.
void let_time_pass() { std::this_thread::sleep_for(std::chrono::milliseconds(2)); }

// All pages of a list.
std::vector<std::string> all_names(Store& store, const std::string& owner, const Filter& filter,
                                   std::size_t page_size) {
  std::vector<std::string> all;
  std::string token;
  do {
    const Page page = store.list(owner, filter, page_size, token);
    EXPECT_LE(page.records.size(), page_size);
    for (const Record& record : page.records) all.push_back(record.name);
    token = page.next_page_token;
  } while (!token.empty());
  return all;
}

TEST_P(Listing, TheLatestComesFirst) {
  Store store(settings_);
  std::vector<std::string> latest_first;
  for (std::uint64_t number = 1; number <= 7; ++number) {
    accept_finished(store, "ada", number);
    latest_first.insert(latest_first.begin(), plan_name(number));
    let_time_pass();
  }
  accept_finished(store, "bob", 8);
  for (const std::size_t page_size : {1, 2, 3, 6, 7, 8, 1000}) {
    EXPECT_EQ(all_names(store, "ada", {}, page_size), latest_first) << page_size;
  }
}

TEST_P(Listing, APlanThatManyHaveIsInEachOnesPlace) {
  Store store(settings_);
  accept_finished(store, "ada", 1);
  let_time_pass();
  accept_finished(store, "bob", 2);
  let_time_pass();
  accept_finished(store, "bob", 1);
  accept_finished(store, "ada", 2);
  EXPECT_EQ(all_names(store, "ada", {}, 10), (std::vector{plan_name(2), plan_name(1)}));
  EXPECT_EQ(all_names(store, "bob", {}, 10), (std::vector{plan_name(1), plan_name(2)}));
}

TEST_P(Listing, AListWithoutPlansIsOneEmptyPage) {
  Store store(settings_);
  const Page page = store.list("ada", {}, 10, "");
  EXPECT_TRUE(page.records.empty());
  EXPECT_TRUE(page.next_page_token.empty());
}

TEST_P(Listing, FiltersTakeWhatTheySay) {
  Store store(settings_);
  const auto only = [&](const Filter& filter) {
    const auto found = all_names(store, "ada", filter, 2);
    return std::set<std::string>(found.begin(), found.end());
  };
  const auto plans = [](std::initializer_list<std::uint64_t> numbers) {
    std::set<std::string> all;
    for (const std::uint64_t number : numbers) all.insert(plan_name(number));
    return all;
  };
  accept_finished(store, "ada", 1, 10, "mill");
  let_time_pass();
  const Time second = accept_finished(store, "ada", 2, 20, "router").create_time;
  let_time_pass();
  const Time third = accept(store, "ada", 3).create_time;
  let_time_pass();
  accept(store, "ada", 4);
  store.refuse(plan_name(4), "no");

  EXPECT_EQ(only({}), plans({1, 2, 3, 4}));
  EXPECT_EQ(only({.machine_name = "router"}), plans({2}));
  EXPECT_EQ(only({.machine_name = "rout"}), plans({}));
  EXPECT_EQ(only({.state = State::kAccepted}), plans({3}));
  EXPECT_EQ(only({.state = State::kFinished}), plans({1, 2}));
  EXPECT_EQ(only({.state = State::kRefused}), plans({4}));
  EXPECT_EQ(only({.created_from = second}), plans({2, 3, 4}));
  EXPECT_EQ(only({.created_before = third}), plans({1, 2}));
  EXPECT_EQ(only({.created_from = second, .created_before = third}), plans({2}));
  EXPECT_EQ(only({.cycle_time_at_least = 10}), plans({1, 2}));
  EXPECT_EQ(only({.cycle_time_at_least = 10.5}), plans({2}));
  EXPECT_EQ(only({.cycle_time_at_most = 10}), plans({1}));
  EXPECT_EQ(only({.machine_name = "mill", .state = State::kFinished, .cycle_time_at_most = 1e300}), plans({1}));
}

TEST_P(Listing, CycleTimesAreComparedExactly) {
  Store store(settings_);
  const double cycle_time = 0.1 + 0.2;
  accept_finished(store, "ada", 1, cycle_time);
  EXPECT_EQ(all_names(store, "ada", {.cycle_time_at_least = cycle_time, .cycle_time_at_most = cycle_time}, 10).size(),
            1);
  EXPECT_TRUE(all_names(store, "ada", {.cycle_time_at_least = std::nextafter(cycle_time, 1.0)}, 10).empty());
  EXPECT_TRUE(all_names(store, "ada", {.cycle_time_at_most = std::nextafter(cycle_time, 0.0)}, 10).empty());
}

TEST_P(Listing, PagesStandStillWhilePlansComeAndGo) {
  Store store(settings_);
  for (std::uint64_t number = 1; number <= 9; ++number) {
    accept_finished(store, "ada", number);
    let_time_pass();
  }
  const Page first = store.list("ada", {}, 3, "");
  EXPECT_EQ(names(first.records), (std::vector{plan_name(9), plan_name(8), plan_name(7)}));
  accept_finished(store, "ada", 10);
  store.remove("ada", plan_name(9));
  store.remove("ada", plan_name(7));  // where the next page begins
  store.remove("ada", plan_name(5));
  const Page second = store.list("ada", {}, 3, first.next_page_token);
  EXPECT_EQ(names(second.records), (std::vector{plan_name(6), plan_name(4), plan_name(3)}));
  const Page third = store.list("ada", {}, 3, second.next_page_token);
  EXPECT_EQ(names(third.records), (std::vector{plan_name(2), plan_name(1)}));
  EXPECT_TRUE(third.next_page_token.empty());
}

TEST_P(Listing, RefusesTokensThatItDidNotGive) {
  Store store(settings_);
  for (std::uint64_t number = 1; number <= 3; ++number) accept_finished(store, "ada", number);
  const Filter filter = {.machine_name = "mill", .cycle_time_at_least = 0.5};
  const std::string token = store.list("ada", filter, 1, "").next_page_token;
  ASSERT_FALSE(token.empty());
  EXPECT_NO_THROW(store.list("ada", filter, 2, token));
  EXPECT_THROW(store.list("bob", filter, 1, token), InvalidPageToken);
  EXPECT_THROW(store.list("ada", {}, 1, token), InvalidPageToken);
  EXPECT_THROW(store.list("ada", {.machine_name = "mill", .cycle_time_at_most = 0.5}, 1, token), InvalidPageToken);
  EXPECT_THROW(store.list("ada", {.machine_name = "mill", .cycle_time_at_least = 0.25}, 1, token), InvalidPageToken);
  for (const std::string& garbage :
       {std::string("x"), std::string(16, '0'), std::string(100, 'f'), token + "0", token.substr(1),
        token.substr(0, token.size() - 1), std::string("x") + token.substr(1), std::string(1'000'000, '9')}) {
    EXPECT_THROW(store.list("ada", filter, 1, garbage), InvalidPageToken) << garbage.substr(0, 100);
  }
  std::string changed = token;
  changed.back() = changed.back() == '0' ? '1' : '0';
  EXPECT_THROW(store.list("ada", filter, 1, changed), InvalidPageToken);
}

}  // namespace
}  // namespace kcs::store
