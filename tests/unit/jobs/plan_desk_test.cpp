#include "server/jobs/plan_desk.h"

#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "server/jobs/cap_exceeded.h"
#include "server/jobs/plan_cache.h"
#include "server/jobs/withdrawn.h"
#include "server/planning/invalid_input.h"
#include "tests/unit/jobs/requests.h"

namespace kcs::jobs {
namespace {

using std::chrono::milliseconds;
using test::endless;
using test::large;
using test::right_angle;

constexpr milliseconds kDeadline{60'000};
constexpr Scheduler::Limits kOneThread{.threads = 1, .queue_length = 100, .client_waiting = 100, .client_running = 1};

// A desk and what it keeps its plans in.
struct Office {
  explicit Office(const Scheduler::Limits& limits = kOneThread) : desk(plans, limits) {}

  PlanCache plans{1000, 1 << 30};
  PlanDesk desk;
};

PlanPointer plan_of(const Ticket& ticket) {
  EXPECT_TRUE(ticket.wait(kDeadline));
  return ticket.plan();
}

bool eventually(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + kDeadline;
  while (!condition() && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(milliseconds(1));
  return condition();
}

bool is_planned(const PlanWatch& watch) {
  return eventually([&] { return watch.progress().state == Progress::State::kPlanning; });
}

// No thread of the desk has anything to do.
bool is_idle(const PlanDesk& desk) {
  return eventually([&] { return desk.load().running == 0 && desk.load().waiting == 0; });
}

TEST(PlanDesk, PlansARequestThatComesManyTimesAtOnceOnlyOnce) {
  Office office;
  const Ticket before = office.desk.submit(large("plans/before"), "anna", Priority::kNormal);  // so that they meet
  constexpr int kClients = 16;
  std::vector<PlanPointer> plans(kClients);
  {
    std::vector<std::jthread> clients;
    for (PlanPointer& plan : plans) {
      const Client client = "client " + std::to_string(clients.size() % 4);
      clients.emplace_back([&office, &plan, client] {
        plan = plan_of(office.desk.submit(right_angle("plans/a"), client, Priority::kNormal));
      });
    }
  }
  // A second planning would have made a second object.
  for (const PlanPointer& plan : plans) EXPECT_EQ(plan, plans.front());
  EXPECT_EQ(office.plans.find("plans/a"), plans.front());
}

TEST(PlanDesk, FailureReachesEveryoneAndIsNotKept) {
  Office office;
  PlanRequest bad = right_angle("plans/b");
  bad.path.segments[1].feed = -1;
  EXPECT_THROW(plan_of(office.desk.submit(bad, "anna", Priority::kNormal)), planning::InvalidInput);
  EXPECT_EQ(office.plans.find("plans/b"), nullptr);
  EXPECT_NE(plan_of(office.desk.submit(right_angle("plans/b"), "anna", Priority::kNormal)), nullptr);
}

TEST(PlanDesk, FullQueueRefusesAndRecovers) {
  Office office({.threads = 1, .queue_length = 0, .client_waiting = 0, .client_running = 1});
  const Ticket first = office.desk.submit(large("plans/large"), "anna", Priority::kNormal);
  EXPECT_THROW(office.desk.submit(right_angle("plans/small"), "anna", Priority::kNormal), CapExceeded);
  EXPECT_NE(plan_of(first), nullptr);
  EXPECT_EQ(plan_of(office.desk.submit(large("plans/large"), "anna", Priority::kNormal)), first.plan());
}

TEST(PlanDesk, GoesOnForTheOthersWhenOneGivesUp) {
  Office office;
  std::optional<Ticket> hers = office.desk.submit(large("plans/a"), "anna", Priority::kNormal);
  ASSERT_TRUE(is_planned(*hers));
  const Ticket his = office.desk.submit(large("plans/a"), "ben", Priority::kNormal);
  hers.reset();
  const PlanPointer plan = plan_of(his);
  EXPECT_EQ(plan, office.plans.find("plans/a"));
}

TEST(PlanDesk, StopsWhatNobodyWaitsForAnyMore) {
  Office office;
  std::optional<Ticket> hers = office.desk.submit(endless("plans/a"), "anna", Priority::kNormal);
  std::optional<Ticket> his = office.desk.submit(endless("plans/a"), "ben", Priority::kNormal);
  ASSERT_TRUE(is_planned(*hers));
  const auto watch = office.desk.watch("plans/a");
  ASSERT_TRUE(watch);
  hers.reset();
  EXPECT_FALSE(watch->progress().over());
  his.reset();
  EXPECT_THROW(watch->plan(), Withdrawn);
  EXPECT_TRUE(is_idle(office.desk));
  EXPECT_EQ(office.plans.find("plans/a"), nullptr);
  EXPECT_FALSE(office.desk.watch("plans/a"));
}

TEST(PlanDesk, DropsWhatWaitsWhenNobodyWaitsForItAnyMore) {
  Office office;
  std::optional<Ticket> first = office.desk.submit(endless("plans/a"), "anna", Priority::kNormal);
  ASSERT_TRUE(is_planned(*first));
  office.desk.submit(right_angle("plans/b"), "anna", Priority::kBatch);  // and goes at once
  EXPECT_EQ(office.desk.load().waiting, 0U);
  first.reset();
  EXPECT_TRUE(is_idle(office.desk));
  EXPECT_EQ(office.plans.find("plans/b"), nullptr);
}

TEST(PlanDesk, GoesOnAloneIfItIsToldTo) {
  Office office;
  office.desk.submit(large("plans/a"), "anna", Priority::kNormal).go_on_alone();
  { const Ticket passing = office.desk.submit(large("plans/a"), "anna", Priority::kNormal); }
  EXPECT_TRUE(eventually([&] { return office.plans.find("plans/a") != nullptr; }));
}

TEST(PlanDesk, StopsWhatGoesOnAloneOnceItIsAbandoned) {
  Office office;
  for (const char* client : {"anna", "ben", "anna"}) {
    office.desk.submit(endless("plans/a"), client, Priority::kNormal).go_on_alone();
  }
  const auto watch = office.desk.watch("plans/a");
  ASSERT_TRUE(watch && is_planned(*watch));
  EXPECT_TRUE(office.desk.abandon("plans/a"));
  EXPECT_TRUE(watch->wait(milliseconds(0)));
  EXPECT_THROW(watch->plan(), Withdrawn);
  EXPECT_TRUE(is_idle(office.desk));
  EXPECT_EQ(office.plans.find("plans/a"), nullptr);
  EXPECT_FALSE(office.desk.abandon("plans/a"));
}

TEST(PlanDesk, GoesOnForThoseWhoWaitWhenItIsAbandoned) {
  Office office;
  office.desk.submit(large("plans/a"), "anna", Priority::kNormal).go_on_alone();
  const Ticket his = office.desk.submit(large("plans/a"), "ben", Priority::kNormal);
  ASSERT_TRUE(is_planned(his));
  EXPECT_FALSE(office.desk.abandon("plans/a"));
  const PlanPointer plan = plan_of(his);
  EXPECT_EQ(plan, office.plans.find("plans/a"));
}

TEST(PlanDesk, StopsWhatIsAbandonedWhenTheLastOfThoseWhoWaitGoes) {
  Office office;
  std::optional<Ticket> hers = office.desk.submit(endless("plans/a"), "anna", Priority::kNormal);
  hers->go_on_alone();
  ASSERT_TRUE(is_planned(*hers));
  EXPECT_FALSE(office.desk.abandon("plans/a"));
  hers.reset();
  EXPECT_TRUE(is_idle(office.desk));
  EXPECT_FALSE(office.desk.watch("plans/a"));
}

TEST(PlanDesk, PlansAgainWhatWasAbandoned) {
  Office office;
  office.desk.submit(large("plans/a"), "anna", Priority::kNormal).go_on_alone();
  EXPECT_TRUE(office.desk.abandon("plans/a"));
  EXPECT_NE(plan_of(office.desk.submit(large("plans/a"), "anna", Priority::kNormal)), nullptr);
}

TEST(PlanDesk, ALongRequestKeepsNoOtherClientWaiting) {
  Office office;
  const Ticket hers = office.desk.submit(endless("plans/a"), "anna", Priority::kInteractive);
  ASSERT_TRUE(is_planned(hers));
  EXPECT_NE(plan_of(office.desk.submit(right_angle("plans/b"), "ben", Priority::kBatch)), nullptr);
  EXPECT_EQ(hers.progress().state, Progress::State::kPlanning);
}

TEST(PlanDesk, WhoJoinsWithAHigherPriorityNeedNotWaitForWhatCameBetween) {
  Office office;
  const Ticket first = office.desk.submit(endless("plans/a"), "anna", Priority::kInteractive);
  ASSERT_TRUE(is_planned(first));
  const Ticket second = office.desk.submit(right_angle("plans/b"), "anna", Priority::kNormal);
  const Ticket batch = office.desk.submit(right_angle("plans/c"), "anna", Priority::kBatch);
  EXPECT_EQ(batch.progress().requests_ahead, 2U);
  const Ticket joined = office.desk.submit(right_angle("plans/c"), "anna", Priority::kInteractive);
  EXPECT_EQ(batch.progress().requests_ahead, 1U);
}

// Holds up whoever keeps a plan.
class SlowKeeper : public PlanKeeper {
 public:
  PlanPointer find(const std::string& name) override { return plans_.find(name); }
  void keep(const PlanPointer& plan) override {
    keeping.set_value();
    opened_.wait();
    plans_.keep(plan);
  }

  std::promise<void> keeping, opened;

 private:
  PlanCache plans_{10, 1 << 20};
  std::future<void> opened_ = opened.get_future();
};

TEST(PlanDesk, WhatIsBeingKeptIsKeptForSureOnceItIsAbandoned) {
  SlowKeeper keeper;
  PlanDesk desk(keeper, kOneThread);
  std::optional<Ticket> ticket = desk.submit(right_angle("plans/a"), "anna", Priority::kNormal);
  keeper.keeping.get_future().wait();
  auto abandoned = std::async(std::launch::async, [&] { return desk.abandon("plans/a"); });
  EXPECT_EQ(abandoned.wait_for(milliseconds(50)), std::future_status::timeout);
  EXPECT_FALSE(ticket->progress().over());
  keeper.opened.set_value();
  EXPECT_FALSE(abandoned.get());
  EXPECT_NE(keeper.find("plans/a"), nullptr);
  EXPECT_NE(plan_of(*ticket), nullptr);
}

// Cannot keep anything.
class BrokenKeeper : public PlanKeeper {
 public:
  PlanPointer find(const std::string& /*name*/) override { return nullptr; }
  void keep(const PlanPointer& /*plan*/) override { throw std::runtime_error("the disk is full"); }
  void refuse(const RequestRecord& request, const std::exception_ptr& reason) noexcept override {
    refused = request.name;
    EXPECT_THROW(std::rethrow_exception(reason), planning::InvalidInput);
  }

  std::string refused;
};

TEST(PlanDesk, NobodyHearsOfAPlanThatCannotBeKept) {
  BrokenKeeper keeper;
  PlanDesk desk(keeper, kOneThread, [](const PlanDesk::Planned&) { ADD_FAILURE() << "it is not kept"; });
  EXPECT_THROW(plan_of(desk.submit(right_angle("plans/a"), "anna", Priority::kNormal)), std::runtime_error);
  EXPECT_EQ(keeper.refused, "");
}

TEST(PlanDesk, ReportsEveryPlanThatItMakesOnce) {
  PlanCache plans(10, 1 << 20);
  std::vector<std::string> calls;
  PlanDesk desk(plans, kOneThread, [&](const PlanDesk::Planned& planned) {
    EXPECT_EQ(plans.find("plans/a").get(), &planned.plan);
    EXPECT_GT(planned.taken.count(), 0);
    calls.push_back(planned.call);
  });
  for (const char* call : {"first", "second"}) {
    PlanRequest request = right_angle("plans/a");
    request.call = call;
    plan_of(desk.submit(std::move(request), "anna", Priority::kNormal));
  }
  EXPECT_EQ(calls, std::vector<std::string>{"first"});
}

TEST(PlanDesk, TellsItsKeeperWhatIsRefused) {
  BrokenKeeper keeper;
  PlanDesk desk(keeper, kOneThread);
  PlanRequest bad = right_angle("plans/a");
  bad.path.segments.clear();
  EXPECT_THROW(plan_of(desk.submit(bad, "anna", Priority::kNormal)), planning::InvalidInput);
  EXPECT_EQ(keeper.refused, "plans/a");
}

}  // namespace
}  // namespace kcs::jobs
