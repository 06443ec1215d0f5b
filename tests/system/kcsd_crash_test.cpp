// kcsd is killed while clients create plans: what it acknowledged is there when it is started again.
//
// KCS_SERVER_KILLS=N kills so many times instead of a few.
#include <signal.h>
#include <stdlib.h>

#include <atomic>
#include <map>
#include <mutex>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "tests/system/shared_store.h"
#include "tests/system/test_kcsd.h"

namespace kcs::test {
namespace {

constexpr int kClients = 4;
constexpr double kPeriod = 0.01;

int kills() {
  const char* given = getenv("KCS_SERVER_KILLS");
  return given ? atoi(given) : 5;
}

// Makes the same plans, and is never killed.
class Reference {
 public:
  struct Made {
    std::uint64_t number;
    std::string content;
  };

  // What becomes of request `number`.
  void add(std::uint64_t number) {
    const auto plan = kcsd_.create(request_of(number));
    ASSERT_TRUE(plan.status.ok()) << plan.status.error_message();
    ASSERT_EQ(plan.message.state(), v1::PLAN_STATE_READY);
    made_[plan.message.name()] = {number, content(plan.message)};
  }

  // None if the name is of no request of the test.
  const Made* find(const std::string& name) const {
    const auto found = made_.find(name);
    return found == made_.end() ? nullptr : &found->second;
  }

  std::vector<std::string> stream(const std::string& name) {
    return bytes(kcsd_.stream(setpoints(name, kPeriod)).message);
  }

 private:
  TestKcsd kcsd_{"[server]\nlog_level = \"info\"\n[caps]\ncached_plans = 100000\n[store]\ndatabase = \"memory\"\n"};
  std::map<std::string, Made> made_;
};

// Clients that create plans until their server is gone.
class Clients {
 public:
  Clients(TestKcsd& kcsd, std::uint64_t first) : next_(first) {
    for (int i = 0; i < kClients; ++i) threads_.emplace_back([this, &kcsd] { create_plans(kcsd); });
  }

  void join() {
    for (std::thread& thread : threads_) thread.join();
  }

  // One past the last request that was made, acknowledged or not.
  std::uint64_t next() const { return next_; }
  const std::vector<v1::Plan>& acknowledged() const { return acknowledged_; }

 private:
  void create_plans(TestKcsd& kcsd) {
    while (true) {
      const std::uint64_t number = next_++;
      const auto request = request_of(number);
      const auto answer = kcsd.create(number % 2 == 0 ? request : accept_only(request));
      if (!answer.status.ok()) {
        EXPECT_EQ(answer.status.error_code(), grpc::StatusCode::UNAVAILABLE) << answer.status.error_message();
        return;
      }
      const std::lock_guard lock(mutex_);
      acknowledged_.push_back(answer.message);
    }
  }

  std::atomic<std::uint64_t> next_;
  std::mutex mutex_;
  std::vector<v1::Plan> acknowledged_;
  std::vector<std::thread> threads_;
};

// What was acknowledged is there as it was.
void check_kept(TestKcsd& kcsd, const v1::Plan& plan) {
  const v1::Plan found = kcsd.wait_until_ready(plan.name());
  EXPECT_EQ(found.create_time().SerializeAsString(), plan.create_time().SerializeAsString());
  EXPECT_TRUE(plan.state() != v1::PLAN_STATE_READY || found.SerializeAsString() == plan.SerializeAsString());
}

template <typename Store>
class KcsdCrash : public ::testing::Test {};

using Stores = ::testing::Types<SqliteStore, PostgresqlStore>;

struct StoreName {
  template <typename Store>
  static std::string GetName(int) {
    return std::is_same_v<Store, SqliteStore> ? "Sqlite" : "Postgresql";
  }
};
TYPED_TEST_SUITE(KcsdCrash, Stores, StoreName);

TYPED_TEST(KcsdCrash, LosesNoPlanThatWasAcknowledged) {
  TypeParam store;
  Reference reference;
  std::mt19937 random(20'262);
  std::uniform_int_distribution milliseconds(0, 250);
  std::vector<v1::Plan> acknowledged;
  std::uint64_t next = 1;
  for (int round = 0; round < kills(); ++round) {
    TestKcsd kcsd(store.settings());
    Clients clients(kcsd, next);
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds(random)));
    kcsd.process().send_signal(SIGKILL);
    clients.join();
    for (; next < clients.next(); ++next) reference.add(next);
    acknowledged.insert(acknowledged.end(), clients.acknowledged().begin(), clients.acknowledged().end());
  }
  ASSERT_GT(acknowledged.size(), 10U);

  TestKcsd kcsd(store.settings());
  for (const v1::Plan& plan : acknowledged) check_kept(kcsd, plan);
  const auto all = kcsd.list_all();
  ASSERT_TRUE(all.status.ok()) << all.status.error_message();
  EXPECT_GE(all.message.size(), acknowledged.size());
  for (const v1::Plan& listed : all.message) {
    const Reference::Made* made = reference.find(listed.name());
    ASSERT_NE(made, nullptr) << listed.name() << " was never asked for";
    EXPECT_EQ(content(kcsd.wait_until_ready(listed.name())), made->content) << made->number;
    if (made->number % 8 >= 2) continue;  // some of either kind
    EXPECT_EQ(bytes(kcsd.stream(setpoints(listed.name(), kPeriod)).message), reference.stream(listed.name()))
        << made->number;
  }
  EXPECT_EQ(kcsd.process().errors().find("[error]"), std::string::npos) << kcsd.process().errors();
}

TYPED_TEST(KcsdCrash, WhatWasOnlyAcceptedIsPlannedAfterwards) {
  constexpr int kManyMoves = 12'000;  // so many that it dies before any of them is made
  TypeParam store;
  std::vector<v1::Plan> accepted;
  {
    TestKcsd kcsd(store.settings());
    for (std::uint64_t number = 1; number <= 2; ++number) {
      const auto answer = kcsd.create(accept_only(request_of(number, kManyMoves)));
      ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
      EXPECT_NE(answer.message.state(), v1::PLAN_STATE_READY);
      accepted.push_back(answer.message);
    }
    kcsd.process().send_signal(SIGKILL);
    kcsd.process().wait();
  }
  TestKcsd kcsd(store.settings());
  for (const v1::Plan& plan : accepted) check_kept(kcsd, plan);
  TestKcsd reference("[store]\ndatabase = \"memory\"\n");
  const auto expected = reference.create(request_of(1, kManyMoves));
  const auto planned = kcsd.get(accepted[0].name());
  EXPECT_EQ(planned.message.state(), v1::PLAN_STATE_READY);
  EXPECT_EQ(content(planned.message), content(expected.message));
}

}  // namespace
}  // namespace kcs::test
