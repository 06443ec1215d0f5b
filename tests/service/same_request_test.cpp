// The same request, asked by many at the same moment.
#include <gtest/gtest.h>

#include <barrier>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "tests/service/kept_plans.h"
#include "tests/service/log_lines.h"
#include "tests/service/secure_client.h"

namespace kcs::service::test {
namespace {

constexpr int kClients = 16;

// The lines of the log that tell of a plan that was made.
std::size_t times_planned(const LogLines& log, const std::string& name) {
  std::size_t times = 0;
  for (const auto& line : log.with("plan", name)) times += line.contains("segments") ? 1 : 0;
  return times;
}

TEST(SameRequest, OfManyAtTheSameMomentIsPlannedOnce) {
  const LogLines log;
  TestServer server({.planning_threads = 2, .log = log.log()});
  std::vector<Answer<v1::Plan>> answers(kClients);
  std::barrier together(kClients);
  std::vector<std::thread> clients;
  for (int i = 0; i < kClients; ++i) {
    clients.emplace_back([&, i] {
      together.arrive_and_wait();
      const auto first = i % 4 == 0 ? accept_only(options()) : request(options());
      answers[static_cast<std::size_t>(i)] = server.create({first, request(long_path())});
    });
  }
  for (std::thread& client : clients) client.join();
  const v1::Plan made = server.wait_until_ready(answers[1].message.name());
  for (int i = 0; i < kClients; ++i) {
    const auto& answer = answers[static_cast<std::size_t>(i)];
    ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
    EXPECT_EQ(answer.message.name(), made.name());
    const bool waited = i % 4 != 0;
    EXPECT_TRUE(!waited || answer.message.SerializeAsString() == made.SerializeAsString());
  }
  EXPECT_EQ(times_planned(log, made.name()), 1U);
  EXPECT_EQ(server.list().message.plans_size(), 1);
}

TEST(SameRequest, OfManyOwnersBelongsToEachOfThem) {
  std::vector<security::KnownToken> tokens;
  for (int i = 0; i < kClients; ++i) tokens.push_back(known("owner" + std::to_string(i), {security::Role::kPlan}));
  TestServer server(with_tokens(tokens));
  std::barrier together(kClients);
  std::vector<std::thread> clients;
  for (int i = 0; i < kClients; ++i) {
    clients.emplace_back([&, i] {
      SecureClient client = client_of(server, "owner" + std::to_string(i));
      // Connected before all start at the same moment; gRPC fails now and then to connect many channels at once.
      EXPECT_TRUE(
          eventually([&] { return client.get("plans/none").status.error_code() == grpc::StatusCode::NOT_FOUND; }));
      together.arrive_and_wait();
      const auto plan = client.create();
      EXPECT_TRUE(plan.status.ok()) << plan.status.error_message();
      EXPECT_TRUE(client.get(plan.message.name()).status.ok());
      EXPECT_TRUE(client.remove(plan.message.name()).ok());
      EXPECT_EQ(client.get(plan.message.name()).status.error_code(), grpc::StatusCode::NOT_FOUND);
    });
  }
  for (std::thread& client : clients) client.join();
}

TEST(SameRequest, IsMadeForThoseWhoStayWhenTheFirstGoes) {
  TestServer server({.planning_threads = 1});
  Call first;
  v1::Plan plan;
  const auto writer = server.stub().CreatePlan(&first, &plan);
  writer->Write(request(options()));
  writer->Write(request(long_path()));
  writer->WritesDone();
  std::vector<std::thread> others;
  std::vector<Answer<v1::Plan>> answers(4);
  for (auto& answer : answers) {
    others.emplace_back([&] { answer = server.create({request(options()), request(long_path())}); });
  }
  first.TryCancel();
  writer->Finish();
  for (std::thread& other : others) other.join();
  for (const auto& answer : answers) EXPECT_TRUE(answer.status.ok()) << answer.status.error_message();
}

}  // namespace
}  // namespace kcs::service::test
