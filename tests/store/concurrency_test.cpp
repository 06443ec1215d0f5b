// Many threads and many servers at the same moment.
#include <atomic>
#include <barrier>
#include <thread>

#include "tests/store/store_test.h"

namespace kcs::store {
namespace {

using Concurrency = StoreTest;
KCS_ON_EACH_DATABASE(Concurrency);

constexpr int kThreads = 8;

// Runs `work(i)` in so many threads, which begin together.
template <typename Work>
void together(const Work& work) {
  std::barrier ready(kThreads);
  std::vector<std::thread> threads;
  for (int i = 0; i < kThreads; ++i) {
    threads.emplace_back([&, i] {
      ready.arrive_and_wait();
      work(i);
    });
  }
  for (std::thread& thread : threads) thread.join();
}

TEST_P(Concurrency, TheSameRequestAtTheSameMomentIsAcceptedOnce) {
  Store first(settings_);
  Store second(settings_);
  const std::string bytes = some_bytes(1, 3'000'000);
  for (std::uint64_t number = 1; number <= 3; ++number) {
    std::vector<Record> records(kThreads);
    together([&](int i) { records[i] = accept(i % 2 ? first : second, "ada", number, bytes); });
    const bool planned_by_first = records[1].to_plan;
    for (int i = 0; i < kThreads; ++i) {
      EXPECT_EQ(records[i].create_time, records[0].create_time);
      EXPECT_EQ(records[i].to_plan, (i % 2 == 1) == planned_by_first);
    }
    EXPECT_TRUE(first.request(plan_name(number)) == bytes);
  }
  EXPECT_EQ(first.list("ada", {}, 100, "").records.size(), 3);
}

TEST_P(Concurrency, OneOutcomeOfManyStays) {
  Store store(settings_);
  for (std::uint64_t number = 1; number <= 5; ++number) {
    accept(store, "ada", number);
    std::vector<std::string> seen(kThreads);
    together([&](int i) {
      const std::string mine = "outcome of " + std::to_string(i);
      i % 2 ? store.finish(plan_name(number), {.plan = mine, .cycle_time = 1}) : store.refuse(plan_name(number), mine);
      seen[i] = store.find("ada", plan_name(number))->outcome;
    });
    for (const std::string& outcome : seen) EXPECT_EQ(outcome, seen[0]);
  }
}

TEST_P(Concurrency, OwnersThatComeAndGoLeaveNothingHalf) {
  Store first(settings_);
  Store second(settings_);
  const std::string bytes = some_bytes(1, 50'000);
  together([&](int i) {
    Store& store = i % 2 ? first : second;
    const std::string owner = "owner " + std::to_string(i);
    for (int round = 0; round < 15; ++round) {
      const Record record = accept(store, owner, 1, bytes);
      EXPECT_EQ(record.name, plan_name(1));
      const auto kept = store.request(plan_name(1));
      EXPECT_TRUE(kept == bytes);
      EXPECT_NE(store.remove(owner, plan_name(1)), Removal::kNotFound);
    }
  });
  EXPECT_FALSE(first.request(plan_name(1)));
  EXPECT_EQ(query(settings_, "select count(*) from request_rows"), "0");
}

TEST_P(Concurrency, EverythingAtTheSameTimeWorks) {
  settings_.connections = 3;
  Store store(settings_);
  together([&](int i) {
    const std::string owner = "owner " + std::to_string(i % 3);
    for (std::uint64_t round = 0; round < 12; ++round) {
      const std::uint64_t number = 100 * static_cast<std::uint64_t>(i) + round;
      const std::string bytes = some_bytes(number, 1000 * round);
      accept(store, owner, number, bytes);
      EXPECT_TRUE(store.request(plan_name(number)) == bytes);
      store.finish(plan_name(number), {.plan = plan_name(number), .cycle_time = 1});
      EXPECT_EQ(store.find(owner, plan_name(number))->outcome, plan_name(number));
      for (const Record& record : store.list(owner, {.state = State::kFinished}, 5, "").records) {
        EXPECT_EQ(record.outcome, record.name);
      }
      if (round % 3 == 0) {
        EXPECT_EQ(store.remove(owner, plan_name(number)), Removal::kGone);
      }
      store.claim(1000);
      store.sweep();
    }
  });
  std::size_t left = 0;
  for (const char* owner : {"owner 0", "owner 1", "owner 2"}) left += store.list(owner, {}, 1000, "").records.size();
  EXPECT_EQ(left, kThreads * 8);
}

TEST_P(Concurrency, OfManyRunsOneBegins) {
  Store first(settings_);
  Store second(settings_);
  accept_finished(first, "ada", 1);
  accept_finished(first, "ada", 2);
  for (int round = 1; round <= 10; ++round) {
    std::vector<std::string> begun(kThreads);
    together([&](int i) {
      try {
        begun[i] = (i % 2 ? first : second).add_run(run_of(1 + i / 2 % 2)).name;
      } catch (const MachineHasRun&) {
      }
    });
    std::erase(begun, "");
    EXPECT_EQ(begun, std::vector{"machines/mill/runs/" + std::to_string(round)});
    std::optional<RunRecord> open = first.open_run("machines/mill");
    ASSERT_TRUE(open);
    open->state = RunRecordState::kAborted;
    second.update_run(*open);
  }
}

TEST_P(Concurrency, EachMachineBeginsItsRun) {
  Store first(settings_);
  Store second(settings_);
  accept_finished(first, "ada", 1);
  together([&](int i) {
    Store& store = i % 2 ? first : second;
    const std::string machine = "machines/" + std::to_string(i);
    for (int round = 1; round <= 10; ++round) {
      RunRecord run = store.add_run(run_of(1, machine));
      EXPECT_EQ(run.name, machine + "/runs/" + std::to_string(round));
      run.state = RunRecordState::kFinished;
      store.update_run(run);
    }
  });
  EXPECT_EQ(query(settings_, "select count(*) from owners"), "1");
}

TEST_P(Concurrency, ARunThatBeginsWhileItsPlanGoesHasItOrIsRefused) {
  settings_.keep_bytes = 1;
  Store first(settings_);
  Store second(settings_);
  for (std::uint64_t round = 1; round <= 10; ++round) {
    accept_finished(first, "ada", round);
    together([&](int i) {
      if (i == 0) first.remove("ada", plan_name(round));
      if (i == 1) second.sweep();
      if (i < 2) return;
      const std::string machine = "machines/" + std::to_string(i);
      try {
        RunRecord run = (i % 2 ? first : second).add_run(run_of(round, machine));
        EXPECT_EQ(second.request(plan_name(round)), "request");
        EXPECT_TRUE(second.find(run.name, plan_name(round)));
        run.state = RunRecordState::kFinished;
        first.update_run(run);
      } catch (const PlanNotKept&) {
        EXPECT_FALSE(first.open_run(machine));
      }
    });
    EXPECT_FALSE(first.request(plan_name(round)));
  }
}

}  // namespace
}  // namespace kcs::store
