#include "server/jobs/scheduler.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "server/jobs/cap_exceeded.h"

namespace kcs::jobs {
namespace {

using std::chrono::milliseconds;

constexpr Scheduler::Limits kOneThread{.threads = 1, .queue_length = 1000, .client_waiting = 1000, .client_running = 1};

// Goes on only when it is told to.
class FakeClock {
 public:
  std::chrono::steady_clock::time_point now() const { return start_ + milliseconds(elapsed_); }
  void advance(milliseconds time) { elapsed_ += time.count(); }
  Scheduler::Clock clock() {
    return [this] { return now(); };
  }

 private:
  const std::chrono::steady_clock::time_point start_{};
  std::atomic<std::int64_t> elapsed_ = 0;  // ms
};

// A job that takes up a thread until it is let go or stopped.
class Blocker {
 public:
  Scheduler::Step step() {
    return [this](const std::stop_token& stop) {
      begun_.store(true);
      while (!open_ && !stop.stop_requested()) std::this_thread::sleep_for(milliseconds(1));
      stopped_ = stop.stop_requested();
      return false;
    };
  }
  void wait_until_begun() const {
    while (!begun_) std::this_thread::sleep_for(milliseconds(1));
  }
  void open() { open_ = true; }
  bool stopped() const { return stopped_; }

 private:
  std::atomic<bool> begun_ = false, open_ = false, stopped_ = false;
};

Scheduler::Step nothing() {
  return [](const std::stop_token&) { return false; };
}

std::optional<CapExceeded> refusal(Scheduler& scheduler, const Client& client) {
  try {
    scheduler.submit(client, Priority::kNormal, nothing());
  } catch (const CapExceeded& refused) {
    return refused;
  }
  return {};
}

TEST(Scheduler, DoesEveryJobOnce) {
  std::vector<std::atomic<int>> steps(500);
  std::atomic<std::size_t> left = steps.size();
  std::promise<void> all;
  Scheduler scheduler({.threads = 3, .queue_length = 500, .client_waiting = 500, .client_running = 3});
  for (auto& mine : steps) {
    scheduler.submit("anna", Priority::kNormal, [&](const std::stop_token&) {
      if (++mine < 3) return true;
      if (--left == 0) all.set_value();
      return false;
    });
  }
  all.get_future().wait();
  for (const auto& mine : steps) EXPECT_EQ(mine, 3);
}

TEST(Scheduler, AVeryLongJobAndAThousandOthersKeepNobodyElseWaiting) {
  FakeClock clock;
  Blocker first;
  Scheduler scheduler({.threads = 1, .queue_length = 2000, .client_waiting = 2000, .client_running = 1}, clock.clock());
  scheduler.submit("anna", Priority::kNormal, first.step());
  first.wait_until_begun();
  std::atomic<int> hers = 0;
  std::promise<int> his;
  const auto a_bit_of_hers = [&](const std::stop_token&) {
    ++hers;
    clock.advance(milliseconds(50));
    return true;  // never done
  };
  for (int i = 0; i < 1000; ++i) scheduler.submit("anna", Priority::kInteractive, a_bit_of_hers);
  scheduler.submit("ben", Priority::kBatch, [&](const std::stop_token&) {
    clock.advance(milliseconds(1));
    his.set_value(hers);
    return false;
  });
  first.open();
  EXPECT_LE(his.get_future().get(), 4);  // two turns
}

TEST(Scheduler, AJobThatWaitsIsGoneAtOnceWhenItsClientLeaves) {
  Blocker blocker;
  Scheduler scheduler(kOneThread);
  scheduler.submit("anna", Priority::kNormal, blocker.step());
  blocker.wait_until_begun();
  auto held = std::make_shared<int>();
  const std::weak_ptr<int> watched = held;
  const JobId job = scheduler.submit("anna", Priority::kNormal, [held](const std::stop_token&) {
    ADD_FAILURE() << "nobody wants it";
    return false;
  });
  held.reset();
  EXPECT_FALSE(watched.expired());
  scheduler.leave(job, "anna");
  EXPECT_TRUE(watched.expired());
  EXPECT_EQ(scheduler.load().waiting, 0U);
  blocker.open();
}

TEST(Scheduler, AJobThatRunsIsAskedToStopWhenItsClientLeaves) {
  Blocker blocker;
  std::promise<void> next;
  Scheduler scheduler(kOneThread);
  const JobId job = scheduler.submit("anna", Priority::kNormal, blocker.step());
  blocker.wait_until_begun();
  scheduler.leave(job, "anna");
  scheduler.submit("anna", Priority::kNormal, [&](const std::stop_token&) {
    next.set_value();
    return false;
  });
  next.get_future().wait();
  EXPECT_TRUE(blocker.stopped());
}

TEST(Scheduler, AJobGoesOnUntilItsLastClientLeaves) {
  Blocker blocker;
  Scheduler scheduler({.threads = 2, .queue_length = 10, .client_waiting = 10, .client_running = 2});
  const JobId job = scheduler.submit("anna", Priority::kNormal, blocker.step());
  blocker.wait_until_begun();
  scheduler.join(job, "ben", Priority::kNormal);
  scheduler.leave(job, "anna");
  EXPECT_FALSE(blocker.stopped());
  EXPECT_EQ(scheduler.load().running, 1U);
  scheduler.leave(job, "ben");
  while (scheduler.load().running > 0) std::this_thread::sleep_for(milliseconds(1));
  EXPECT_TRUE(blocker.stopped());
}

TEST(Scheduler, RefusesWhatDoesNotFitIntoTheQueue) {
  Blocker blockers[2];
  Scheduler scheduler({.threads = 2, .queue_length = 3, .client_waiting = 100, .client_running = 2});
  for (Blocker& blocker : blockers) scheduler.submit("anna", Priority::kNormal, blocker.step());
  for (const Blocker& blocker : blockers) blocker.wait_until_begun();
  for (int i = 0; i < 3; ++i) scheduler.submit("anna", Priority::kNormal, nothing());
  const auto refused = refusal(scheduler, "ben");
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->cap(), "queue_length");
  EXPECT_TRUE(refused->retry_after());
  for (Blocker& blocker : blockers) blocker.open();
}

TEST(Scheduler, RefusesAClientWhoHasTooManyWaitingAndNoOther) {
  Blocker blocker;
  Scheduler scheduler({.threads = 1, .queue_length = 100, .client_waiting = 2, .client_running = 1});
  scheduler.submit("anna", Priority::kNormal, blocker.step());
  blocker.wait_until_begun();
  scheduler.submit("anna", Priority::kNormal, nothing());
  const JobId last = scheduler.submit("anna", Priority::kNormal, nothing());
  const auto refused = refusal(scheduler, "anna");
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->cap(), "client_waiting");
  EXPECT_FALSE(refusal(scheduler, "ben"));
  // What she waits for already she may ask for again, but for nothing else.
  EXPECT_NO_THROW(scheduler.join(last, "anna", Priority::kInteractive));
  const JobId his = scheduler.submit("ben", Priority::kNormal, nothing());
  EXPECT_THROW(scheduler.join(his, "anna", Priority::kNormal), CapExceeded);
  blocker.open();
}

TEST(Scheduler, TellsWhenTryingAgainIsWorthIt) {
  FakeClock clock;
  Blocker blocker;
  Scheduler scheduler({.threads = 1, .queue_length = 3, .client_waiting = 100, .client_running = 1}, clock.clock());
  for (int i = 0; i < 50; ++i) {
    std::promise<void> begun;
    scheduler.submit("anna", Priority::kNormal, [&](const std::stop_token&) {
      clock.advance(milliseconds(2000));
      begun.set_value();
      return false;
    });
    begun.get_future().wait();
    while (scheduler.load().running > 0) std::this_thread::yield();
  }
  scheduler.submit("anna", Priority::kNormal, blocker.step());
  blocker.wait_until_begun();
  for (int i = 0; i < 3; ++i) scheduler.submit("anna", Priority::kNormal, nothing());
  const auto refused = refusal(scheduler, "anna");
  ASSERT_TRUE(refused && refused->retry_after());
  // Three wait, two seconds each.
  EXPECT_NEAR(static_cast<double>(refused->retry_after()->count()), 6000, 100);
  blocker.open();
}

TEST(Scheduler, LeavesTheOtherThreadsToOtherClients) {
  Blocker hers[2], his;
  Scheduler scheduler({.threads = 2, .queue_length = 100, .client_waiting = 100, .client_running = 1});
  for (Blocker& blocker : hers) scheduler.submit("anna", Priority::kNormal, blocker.step());
  hers[0].wait_until_begun();
  EXPECT_EQ(scheduler.load().waiting, 1U);
  scheduler.submit("ben", Priority::kBatch, his.step());
  his.wait_until_begun();
  EXPECT_EQ(scheduler.load().running, 2U);
  // Her second one begins as soon as the first has ended, on whichever thread that is free.
  hers[0].open();
  hers[1].wait_until_begun();
  hers[1].open();
  his.open();
}

TEST(Scheduler, DropsWhatWaitsAndStopsWhatRunsWhenItGoes) {
  Blocker blocker;
  std::atomic<bool> dropped_job_ran = false;
  {
    Scheduler scheduler(kOneThread);
    scheduler.submit("anna", Priority::kNormal, blocker.step());
    blocker.wait_until_begun();
    scheduler.submit("anna", Priority::kNormal, [&](const std::stop_token&) {
      dropped_job_ran = true;
      return false;
    });
  }
  EXPECT_TRUE(blocker.stopped());
  EXPECT_FALSE(dropped_job_ran);
}

}  // namespace
}  // namespace kcs::jobs
