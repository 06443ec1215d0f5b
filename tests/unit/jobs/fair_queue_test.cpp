#include "server/jobs/fair_queue.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <vector>

namespace kcs::jobs {
namespace {

using testing::ElementsAre;
using Time = FairQueue::Time;

constexpr std::size_t kAnyNumber = 1000;
constexpr Time kTurn{0.1};

// Jobs are named 100 × the client's number + their own: whose turn it is can be read off.
constexpr JobId kAnna = 10'000, kBen = 20'000;

void add_many(FairQueue& queue, const Client& client, JobId first, std::size_t count,
              Priority priority = Priority::kNormal) {
  for (std::size_t i = 0; i < count; ++i) queue.add(first + i, client, priority);
}

// Has each job done in one turn of this length; which ones, in their order.
std::vector<JobId> do_all(FairQueue& queue, Time used = kTurn) {
  std::vector<JobId> done;
  while (const auto turn = queue.take()) {
    queue.give_back(*turn, used);
    queue.remove(turn->job);
    done.push_back(turn->job);
  }
  return done;
}

TEST(FairQueue, LetsClientsTakeTurnsHoweverManyJobsOneOfThemHas) {
  FairQueue queue(kAnyNumber, kTurn);
  add_many(queue, "anna", kAnna, 1000);
  add_many(queue, "ben", kBen, 2);
  const auto done = do_all(queue);
  EXPECT_EQ(done.size(), 1002U);
  EXPECT_THAT(std::vector(done.begin(), done.begin() + 5), ElementsAre(kAnna, kBen, kAnna + 1, kBen + 1, kAnna + 2));
}

TEST(FairQueue, GivesClientsTheSameTimeHoweverLongTheirJobsAre) {
  FairQueue queue(kAnyNumber, kTurn);
  add_many(queue, "anna", kAnna, 1000);
  add_many(queue, "ben", kBen, 1000);
  std::map<Client, Time> used;
  for (int i = 0; i < 500; ++i) {
    const auto turn = queue.take();
    const Time time(turn->client == "anna" ? 10 : 0.1);
    queue.give_back(*turn, time);
    queue.remove(turn->job);
    used[turn->client] += time;
    ASSERT_LE(std::abs((used["anna"] - used["ben"]).count()), 10 + 1e-9);
  }
}

TEST(FairQueue, LetsOthersInBetweenTheTurnsOfALongJob) {
  FairQueue queue(kAnyNumber, kTurn);
  queue.add(kAnna, "anna", Priority::kInteractive);
  for (int i = 0; i < 100; ++i) queue.give_back(*queue.take(), kTurn);
  queue.add(kBen, "ben", Priority::kBatch);
  EXPECT_EQ(queue.take()->job, kBen);
}

TEST(FairQueue, NobodySavesUpTimeWhileHeHasNothingToDo) {
  FairQueue queue(kAnyNumber, kTurn);
  add_many(queue, "anna", kAnna, 1000);
  for (int i = 0; i < 100; ++i) queue.give_back(*queue.take(), kTurn);
  add_many(queue, "ben", kBen, 1000);
  std::map<Client, int> turns;
  for (int i = 0; i < 20; ++i) {
    const auto turn = queue.take();
    ++turns[turn->client];
    queue.give_back(*turn, kTurn);
  }
  EXPECT_EQ(turns["anna"], 10);
  EXPECT_EQ(turns["ben"], 10);
}

TEST(FairQueue, NobodyIsRidOfWhatHeUsedByGoingAway) {
  FairQueue queue(kAnyNumber, kTurn);
  add_many(queue, "ben", kBen, 1000);
  queue.add(kAnna, "anna", Priority::kNormal);
  for (bool anna = false; !anna;) {
    const auto turn = queue.take();
    anna = turn->client == "anna";
    queue.give_back(*turn, anna ? 50 * kTurn : kTurn);
    if (anna) queue.remove(turn->job);
  }
  queue.add(kAnna + 1, "anna", Priority::kNormal);
  for (int i = 0; i < 48; ++i) {
    const auto turn = queue.take();
    ASSERT_EQ(turn->client, "ben") << i;
    queue.give_back(*turn, kTurn);
  }
}

TEST(FairQueue, TakesAClientsOwnJobsByPriorityAndThenInOrder) {
  FairQueue queue(kAnyNumber, kTurn);
  queue.add(1, "anna", Priority::kBatch);
  queue.add(2, "anna", Priority::kNormal);
  queue.add(3, "anna", Priority::kNormal);
  queue.add(4, "anna", Priority::kInteractive);
  queue.add(5, "anna", Priority::kBatch);
  EXPECT_THAT(do_all(queue), ElementsAre(4, 2, 3, 1, 5));
}

TEST(FairQueue, PrioritiesOfOneClientDoNotConcernAnother) {
  FairQueue queue(kAnyNumber, kTurn);
  add_many(queue, "anna", kAnna, 2, Priority::kInteractive);
  add_many(queue, "ben", kBen, 2, Priority::kBatch);
  EXPECT_THAT(do_all(queue), ElementsAre(kAnna, kBen, kAnna + 1, kBen + 1));
}

TEST(FairQueue, RaisesAPriorityButLowersNone) {
  FairQueue queue(kAnyNumber, kTurn);
  add_many(queue, "anna", 1, 3);
  queue.add(3, "anna", Priority::kInteractive);
  queue.add(1, "anna", Priority::kBatch);
  EXPECT_THAT(do_all(queue), ElementsAre(3, 1, 2));
}

TEST(FairQueue, DoesAJobOfTwoClientsOnceWhenTheFirstOfThemHasHisTurn) {
  FairQueue queue(kAnyNumber, kTurn);
  add_many(queue, "anna", kAnna, 100);
  queue.add(kAnna + 99, "ben", Priority::kBatch);
  const auto done = do_all(queue);
  EXPECT_EQ(done.size(), 100U);
  EXPECT_EQ(done[1], kAnna + 99);
}

TEST(FairQueue, KeepsAJobAsLongAsOneClientWaitsForIt) {
  FairQueue queue(kAnyNumber, kTurn);
  queue.add(1, "anna", Priority::kNormal);
  queue.add(1, "ben", Priority::kNormal);
  EXPECT_TRUE(queue.leave(1, "anna"));
  EXPECT_EQ(queue.waiting("anna"), 0U);
  EXPECT_EQ(queue.waiting(), 1U);
  EXPECT_FALSE(queue.leave(1, "ben"));
  EXPECT_EQ(queue.waiting(), 0U);
  EXPECT_FALSE(queue.take());
}

TEST(FairQueue, WhatIsRemovedDuringItsTurnDoesNotComeBack) {
  FairQueue queue(kAnyNumber, kTurn);
  queue.add(1, "anna", Priority::kNormal);
  const auto turn = queue.take();
  queue.remove(1);
  queue.give_back(*turn, kTurn);
  EXPECT_FALSE(queue.take());
  EXPECT_EQ(queue.running("anna"), 0U);
}

TEST(FairQueue, GivesAClientNoMoreTurnsAtTheSameTimeThanAllowed) {
  FairQueue queue(2, kTurn);
  add_many(queue, "anna", kAnna, 5);
  const auto first = queue.take(), second = queue.take();
  EXPECT_FALSE(queue.take());
  queue.add(kBen, "ben", Priority::kBatch);
  EXPECT_EQ(queue.take()->job, kBen);
  queue.give_back(*first, kTurn);
  EXPECT_EQ(queue.take()->client, "anna");
  EXPECT_FALSE(queue.take());
}

TEST(FairQueue, SharesTheThreadsOfOneMomentToo) {
  FairQueue queue(kAnyNumber, kTurn);
  add_many(queue, "anna", kAnna, 5);
  add_many(queue, "ben", kBen, 5);
  std::map<Client, int> running;
  for (int i = 0; i < 4; ++i) ++running[queue.take()->client];
  EXPECT_EQ(running["anna"], 2);
}

TEST(FairQueue, TellsHowManyGoFirst) {
  FairQueue queue(kAnyNumber, kTurn);
  add_many(queue, "anna", kAnna, 10);
  EXPECT_EQ(queue.ahead(kAnna), 0U);
  EXPECT_EQ(queue.ahead(kAnna + 9), 9U);
  add_many(queue, "ben", kBen, 3);
  EXPECT_EQ(queue.ahead(kBen + 2), 2U + 2U);   // two of his own, and as many of hers
  EXPECT_EQ(queue.ahead(kAnna + 9), 9U + 3U);  // all of his
  const auto turn = queue.take();              // hers: now he goes first
  EXPECT_EQ(queue.ahead(turn->job), 0U);
  EXPECT_EQ(queue.ahead(kBen), 0U);
  EXPECT_EQ(queue.ahead(kAnna + 1), 1U + 1U);
  EXPECT_EQ(queue.ahead(4711), 0U);
}

}  // namespace
}  // namespace kcs::jobs
