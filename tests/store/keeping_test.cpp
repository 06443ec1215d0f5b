// What is kept, for whom, and until when.
#include <thread>

#include "tests/store/store_test.h"

namespace kcs::store {
namespace {

using Keeping = StoreTest;
KCS_ON_EACH_DATABASE(Keeping);

constexpr std::string_view kZeros("\0\xff\0'", 4);

TEST_P(Keeping, AnAcceptedRequestIsKept) {
  const auto before = std::chrono::system_clock::now() - std::chrono::seconds(2);
  Store store(settings_);
  const Record accepted = accept(store, "ada", 1);
  EXPECT_EQ(accepted.name, plan_name(1));
  EXPECT_EQ(accepted.state, State::kAccepted);
  EXPECT_TRUE(accepted.to_plan);
  EXPECT_GT(accepted.create_time, before);
  EXPECT_LT(accepted.create_time, std::chrono::system_clock::now() + std::chrono::seconds(2));
  EXPECT_EQ(store.request(plan_name(1)), "request");
}

TEST_P(Keeping, WhatIsKeptIsThereWhenTheStoreIsOpenedAgain) {
  Time create_time;
  {
    Store store(settings_);
    create_time = accept_finished(store, "ada", 1).create_time;
    accept(store, "ada", 2);
  }
  Store store(settings_);
  const std::optional<Record> found = store.find("ada", plan_name(1));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->state, State::kFinished);
  EXPECT_EQ(found->outcome, "plan");
  EXPECT_EQ(found->create_time, create_time);
  EXPECT_EQ(store.find("ada", plan_name(2))->state, State::kAccepted);
  EXPECT_EQ(store.request(plan_name(2)), "request");
}

TEST_P(Keeping, AcceptingTwiceIsAcceptingOnce) {
  Store store(settings_);
  const Record first = accept(store, "ada", 1);
  const Record second = accept(store, "ada", 1);
  EXPECT_EQ(second.create_time, first.create_time);
  EXPECT_TRUE(second.to_plan);
  EXPECT_EQ(store.list("ada", {}, 10, "").records.size(), 1);
  store.finish(plan_name(1), {.plan = "plan", .cycle_time = 1});
  const Record third = accept(store, "ada", 1);
  EXPECT_EQ(third.state, State::kFinished);
  EXPECT_EQ(third.outcome, "plan");
  EXPECT_FALSE(third.to_plan);
}

TEST_P(Keeping, BytesComeBackExactly) {
  Store store(settings_);
  std::string all;
  for (int i = 0; i < 256; ++i) all.push_back(static_cast<char>(i));
  std::uint64_t number = 0;
  for (const std::string& bytes : {std::string(), std::string(1, '\0'), all, some_bytes(1, (2 << 20) - 1),
                                   some_bytes(2, 2 << 20), some_bytes(3, (2 << 20) + 1), some_bytes(4, 9'000'000)}) {
    accept(store, "ada", ++number, bytes);
    EXPECT_TRUE(store.request(plan_name(number)) == bytes) << bytes.size() << " bytes";
  }
  for (const std::string& bytes : {std::string(), std::string(kZeros), some_bytes(5, 100'000)}) {
    accept(store, "ada", ++number);
    store.finish(plan_name(number), {.plan = bytes});
    EXPECT_TRUE(store.find("ada", plan_name(number))->outcome == bytes) << bytes.size() << " bytes";
  }
}

TEST_P(Keeping, TheLargestRequestsFit) {
  settings_.timeout = std::chrono::minutes(1);  // under a sanitizer it takes its time
  Store store(settings_);
  const std::string bytes = some_bytes(1, 100'000'000);
  accept(store, "ada", 1, bytes);
  EXPECT_TRUE(store.request(plan_name(1)) == bytes);
  EXPECT_EQ(store.remove("ada", plan_name(1)), Removal::kGone);
}

TEST_P(Keeping, AnOwnerSeesAndRemovesOnlyWhatIsHis) {
  Store store(settings_);
  const Record hers = accept_finished(store, "ada", 1);
  EXPECT_FALSE(store.find("bob", plan_name(1)));
  EXPECT_TRUE(store.list("bob", {}, 10, "").records.empty());
  EXPECT_EQ(store.remove("bob", plan_name(1)), Removal::kNotFound);
  EXPECT_TRUE(store.find("ada", plan_name(1)));

  std::this_thread::sleep_for(std::chrono::milliseconds(2));
  const Record his = accept(store, "bob", 1);
  EXPECT_EQ(his.state, State::kFinished);
  EXPECT_EQ(his.outcome, "plan");
  EXPECT_GT(his.create_time, hers.create_time);
  EXPECT_EQ(store.find("ada", plan_name(1))->create_time, hers.create_time);
  EXPECT_EQ(store.list("bob", {}, 10, "").records.front().create_time, his.create_time);

  EXPECT_EQ(store.remove("ada", plan_name(1)), Removal::kOthersKeepIt);
  EXPECT_FALSE(store.find("ada", plan_name(1)));
  EXPECT_EQ(store.remove("ada", plan_name(1)), Removal::kNotFound);
  EXPECT_TRUE(store.find("bob", plan_name(1)));
  EXPECT_TRUE(store.request(plan_name(1)));
  EXPECT_EQ(store.remove("bob", plan_name(1)), Removal::kGone);
  EXPECT_FALSE(store.request(plan_name(1)));
  for (const char* table : {"plans", "owners", "request_rows"}) {
    EXPECT_EQ(query(settings_, std::string("select count(*) from ") + table), "0") << table;
  }
}

TEST_P(Keeping, WhatIsRemovedMayComeBack) {
  Store store(settings_);
  accept_finished(store, "ada", 1);
  store.remove("ada", plan_name(1));
  const Record again = accept(store, "ada", 1);
  EXPECT_EQ(again.state, State::kAccepted);
  EXPECT_EQ(store.request(plan_name(1)), "request");
}

TEST_P(Keeping, TheFirstOutcomeStays) {
  Store store(settings_);
  accept(store, "ada", 1);
  store.finish(plan_name(1), {.plan = "first", .cycle_time = 1});
  store.finish(plan_name(1), {.plan = "second", .cycle_time = 2});
  store.refuse(plan_name(1), "third");
  EXPECT_EQ(store.find("ada", plan_name(1))->state, State::kFinished);
  EXPECT_EQ(store.find("ada", plan_name(1))->outcome, "first");
  EXPECT_TRUE(store.list("ada", {.cycle_time_at_least = 2}, 10, "").records.empty());

  accept(store, "ada", 2);
  store.refuse(plan_name(2), kZeros);
  store.finish(plan_name(2), {.plan = "second", .cycle_time = 2});
  EXPECT_EQ(store.find("ada", plan_name(2))->state, State::kRefused);
  EXPECT_EQ(store.find("ada", plan_name(2))->outcome, kZeros);
  EXPECT_EQ(accept(store, "bob", 2).state, State::kRefused);
}

TEST_P(Keeping, AnOutcomeOfWhatIsGoneChangesNothing) {
  Store store(settings_);
  accept(store, "ada", 1);
  store.remove("ada", plan_name(1));
  store.finish(plan_name(1), {.plan = "late", .cycle_time = 1});
  store.refuse(plan_name(1), "late");
  EXPECT_FALSE(store.find("ada", plan_name(1)));
  EXPECT_TRUE(store.list("ada", {}, 10, "").records.empty());
}

TEST_P(Keeping, AFinishedPlanSettlesARequestThatWaits) {
  Store store(settings_);
  accept(store, "ada", 1);
  EXPECT_EQ(accept_finished(store, "bob", 1).state, State::kFinished);
  EXPECT_EQ(store.find("ada", plan_name(1))->state, State::kFinished);
  EXPECT_TRUE(store.claim(10).empty());
}

TEST_P(Keeping, AFinishedPlanReplacesARefusal) {
  Store store(settings_);
  const auto stored_bytes = [this] { return query(settings_, "select stored_bytes from plans"); };
  accept_finished(store, "ada", 1);
  const std::string expected = stored_bytes();
  store.remove("ada", plan_name(1));

  accept(store, "ada", 1);
  store.refuse(plan_name(1), kZeros);
  const Record finished = accept_finished(store, "bob", 1, 2);
  EXPECT_EQ(finished.state, State::kFinished);
  EXPECT_EQ(finished.outcome, "plan");
  EXPECT_EQ(store.find("ada", plan_name(1))->state, State::kFinished);
  EXPECT_EQ(store.list("ada", {.cycle_time_at_least = 2}, 10, "").records.size(), 1);
  EXPECT_EQ(stored_bytes(), expected);
}

TEST_P(Keeping, NamesThatNobodyGaveAreNotFound) {
  Store store(settings_);
  accept_finished(store, "ada", 1);
  for (const std::string& name :
       {std::string(), std::string("plans/1"), plan_name(1) + " ", plan_name(1) + '\0', plan_name(1) + '\0' + "x",
        std::string("plans/' or ''='"), std::string(100'000, 'a')}) {
    EXPECT_FALSE(store.find("ada", name));
    EXPECT_FALSE(store.request(name));
    EXPECT_EQ(store.remove("ada", name), Removal::kNotFound);
  }
  EXPECT_TRUE(store.list("ada", {.machine_name = std::string("mill\0", 5)}, 10, "").records.empty());
}

TEST_P(Keeping, OwnersAndMachinesMayHaveAnyLetters) {
  Store store(settings_);
  for (const std::string& name :
       {std::string("Fräse 'Ü' \"3\"\\"), std::string("加工機 ✂"), std::string("%_"), std::string()}) {
    const Request request = {.name = plan_name(1), .machine_name = name, .bytes = "request"};
    store.accept(name, request);
    EXPECT_EQ(store.list(name, {.machine_name = name}, 10, "").records.size(), 1) << name;
    EXPECT_EQ(store.remove(name, plan_name(1)), Removal::kGone);
  }
}

}  // namespace
}  // namespace kcs::store
