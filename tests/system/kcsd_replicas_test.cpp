// Two kcsd that share a database are one service.
#include <signal.h>

#include <barrier>
#include <string>
#include <thread>
#include <vector>

#include "tests/system/shared_store.h"
#include "tests/system/test_kcsd.h"

namespace kcs::test {
namespace {

constexpr int kManyMoves = 12'000;  // some tenths of a second to plan

class Replicas : public ::testing::Test {
 protected:
  PostgresqlStore store_;
  const std::string settings_ = "[server]\nthreads = 1\n" + store_.settings();
};

TEST_F(Replicas, MakeOnePlanOfTheSameRequestAtTheSameMoment) {
  TestKcsd one(settings_), other(settings_);
  constexpr std::uint64_t kRounds = 10, kClients = 6;
  std::barrier together(kClients);
  std::vector<std::vector<v1::Plan>> plans(kClients);
  std::vector<std::thread> clients;
  for (std::uint64_t client = 0; client < kClients; ++client) {
    clients.emplace_back([&, client] {
      TestKcsd& mine = client % 2 == 0 ? one : other;
      for (std::uint64_t round = 1; round <= kRounds; ++round) {
        const auto request = request_of(round);
        together.arrive_and_wait();
        const auto answer = mine.create(client % 3 == 0 ? accept_only(request) : request);
        EXPECT_TRUE(answer.status.ok()) << answer.status.error_message();
        plans[client].push_back(mine.wait_until_ready(answer.message.name()));
      }
    });
  }
  for (std::thread& client : clients) client.join();
  for (const auto& of_one_client : plans) {
    ASSERT_EQ(of_one_client.size(), kRounds);
    for (std::size_t round = 0; round < kRounds; ++round) {
      EXPECT_EQ(of_one_client[round].SerializeAsString(), plans[0][round].SerializeAsString());
    }
  }
  EXPECT_EQ(one.list_all().message.size(), kRounds);
  EXPECT_EQ(other.list_all().message.size(), kRounds);
}

TEST_F(Replicas, StreamWhatTheOtherHasMadeAndForgetWhatItHasForgotten) {
  TestKcsd one(settings_), other(settings_);
  const auto plan = one.create(request_of(1));
  ASSERT_TRUE(plan.status.ok()) << plan.status.error_message();
  auto request = setpoints(plan.message.name(), 1e-3);
  for (const auto channel : {v1::CHANNEL_VELOCITY, v1::CHANNEL_JERK, v1::CHANNEL_SEGMENT, v1::CHANNEL_LINE})
    request.add_channels(channel);
  const auto expected = one.stream(request);
  const auto streamed = other.stream(request);
  EXPECT_TRUE(streamed.status.ok()) << streamed.status.error_message();
  EXPECT_FALSE(expected.message.empty());
  EXPECT_EQ(bytes(streamed.message), bytes(expected.message));
  EXPECT_EQ(other.get(plan.message.name()).message.SerializeAsString(), plan.message.SerializeAsString());
  EXPECT_TRUE(other.remove(plan.message.name()).ok());
  EXPECT_EQ(one.get(plan.message.name()).status.error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(one.stream(request).status.error_code(), grpc::StatusCode::NOT_FOUND);
}

// What one of them has accepted when it ends in this way.
void expect_other_takes_over(TestKcsd& one, TestKcsd& other, int signal) {
  std::vector<std::string> names;
  for (std::uint64_t number = 1; number <= 3; ++number) {
    const auto accepted = one.create(accept_only(request_of(number, kManyMoves)));
    ASSERT_TRUE(accepted.status.ok()) << accepted.status.error_message();
    names.push_back(accepted.message.name());
  }
  EXPECT_NE(one.get(names.back()).message.state(), v1::PLAN_STATE_READY);
  one.process().send_signal(signal);
  one.process().wait();
  for (const std::string& name : names) {
    EXPECT_EQ(other.wait_until_ready(name).summary().segment_count(), kManyMoves);
    auto request = setpoints(name, 1e-3);
    request.set_last_index(10'000);
    EXPECT_TRUE(other.stream(request).status.ok());
  }
}

TEST_F(Replicas, TakeUpWhatAKilledOneHadAccepted) {
  TestKcsd one(settings_), other(settings_);
  expect_other_takes_over(one, other, SIGKILL);
}

TEST_F(Replicas, TakeUpWhatAStoppedOneGaveBackWithoutWaitingForItsLease) {
  std::string patient = settings_;
  patient.replace(patient.find("lease_s = 1.0"), 13, "lease_s = 3600.0");
  TestKcsd one(patient), other(patient);
  expect_other_takes_over(one, other, SIGTERM);
}

TEST_F(Replicas, TellOfThePlanThatTheOtherMakes) {
  TestKcsd one(settings_), other(settings_);
  const auto accepted = one.create(accept_only(request_of(1, kManyMoves)));
  ASSERT_TRUE(accepted.status.ok()) << accepted.status.error_message();
  const auto progress = other.watch(accepted.message.name());
  EXPECT_TRUE(progress.status.ok()) << progress.status.error_message();
  ASSERT_FALSE(progress.message.empty());
  EXPECT_EQ(progress.message.back().state(), v1::PLAN_STATE_READY);
  EXPECT_EQ(progress.message.back().segments_planned(), static_cast<std::uint64_t>(kManyMoves));
}

}  // namespace
}  // namespace kcs::test
