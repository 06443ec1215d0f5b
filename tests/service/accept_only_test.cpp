// Requests that are accepted first and planned later, whoever is there by then.
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "server/store/store.h"
#include "tests/files/temporary_folder.h"
#include "tests/service/kept_plans.h"

namespace kcs::service::test {
namespace {

std::string all_setpoints(TestServer& server, const std::string& name) {
  std::string bytes;
  const auto answer = server.stream(setpoints(name, 0.01));
  EXPECT_TRUE(answer.status.ok()) << answer.status.error_message();
  for (const v1::SetpointBatch& batch : answer.message) bytes += batch.SerializeAsString();
  return bytes;
}

TEST(AcceptOnly, AnswersBeforeThePlanIsMade) {
  TestServer server({.planning_threads = 1});
  const auto accepted = server.create(join(accept_only(blended()), endless_path()));
  ASSERT_TRUE(accepted.status.ok()) << accepted.status.error_message();
  EXPECT_TRUE(accepted.message.state() == v1::PLAN_STATE_WAITING || accepted.message.state() == v1::PLAN_STATE_PLANNING)
      << accepted.message.state();
  EXPECT_GT(accepted.message.create_time().seconds(), 0);
  EXPECT_FALSE(accepted.message.has_summary());
  EXPECT_FALSE(accepted.message.has_options());
  const auto found = server.get(accepted.message.name());
  EXPECT_TRUE(found.status.ok()) << found.status.error_message();
  EXPECT_FALSE(found.message.has_summary());
  EXPECT_TRUE(
      eventually([&] { return server.get(accepted.message.name()).message.state() == v1::PLAN_STATE_PLANNING; }));
  EXPECT_TRUE(server.remove(accepted.message.name()).ok());
}

TEST(AcceptOnly, MakesThePlanThatIsMadeForThoseWhoWait) {
  TestServer patient;
  const auto expected = patient.create({request(options()), request(long_path())});
  ASSERT_TRUE(expected.status.ok()) << expected.status.error_message();
  TestServer server;
  const auto accepted = server.create({accept_only(options()), request(long_path())});
  ASSERT_TRUE(accepted.status.ok()) << accepted.status.error_message();
  EXPECT_EQ(accepted.message.name(), expected.message.name());
  // A stream of it waits until it is made.
  EXPECT_EQ(all_setpoints(server, expected.message.name()), all_setpoints(patient, expected.message.name()));
  EXPECT_EQ(content(server.wait_until_ready(expected.message.name())), content(expected.message));
  const auto again = server.create({accept_only(options()), request(long_path())});
  EXPECT_EQ(again.message.state(), v1::PLAN_STATE_READY);
  EXPECT_EQ(content(again.message), content(expected.message));
}

TEST(AcceptOnly, PlansEvenIfTheClientGoes) {
  TestServer server({.planning_threads = 1});
  std::string name;
  {
    Call call;
    v1::Plan plan;
    const auto stub = v1::PlanningService::NewStub(new_channel(server.address()));
    const auto writer = stub->CreatePlan(&call, &plan);
    writer->Write(accept_only(options()));
    writer->Write(request(long_path()));
    writer->WritesDone();
    ASSERT_TRUE(writer->Finish().ok());
    name = plan.name();
  }
  EXPECT_EQ(server.wait_until_ready(name).summary().segment_count(),
            static_cast<std::uint64_t>(long_path().points_mm_size()) / 2 - 1);
}

TEST(AcceptOnly, IsWhatItTakesForAPlanToOutliveItsClient) {
  TestServer server({.planning_threads = 1});
  Call call;
  v1::Plan plan;
  const auto writer = server.stub().CreatePlan(&call, &plan);
  writer->Write(request(blended()));
  for (const auto& message : endless_path()) writer->Write(message);
  writer->WritesDone();
  EXPECT_TRUE(server.create({request(options()), request(right_angle())}).status.ok());
  call.TryCancel();
  EXPECT_EQ(writer->Finish().error_code(), grpc::StatusCode::CANCELLED);
  EXPECT_EQ(server.list().message.plans_size(), 1) << "what nobody waited for is kept";
}

TEST(AcceptOnly, ShortPlansAndRefusalsAreThereSoon) {
  TestServer server;
  const auto began = std::chrono::steady_clock::now();
  for (int i = 1; i <= 50; ++i) {
    const auto accepted = server.create({accept_only(options()), request(path({0, 0, 10.0 + i, 0}))});
    ASSERT_TRUE(accepted.status.ok()) << accepted.status.error_message();
    server.wait_until_ready(accepted.message.name());
    const auto refused = server.create({accept_only(too_fast_at_the_end()), request(path({0, 0, 1e-3 * i, 0}))});
    ASSERT_TRUE(refused.status.ok()) << refused.status.error_message();
    ASSERT_TRUE(eventually([&] { return !server.get(refused.message.name()).status.ok(); }));
  }
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(5));
}

TEST(AcceptOnly, SaysWhyARequestWasRefusedUntilItIsDeleted) {
  TestServer server;
  const std::vector waiting = {request(too_fast_at_the_end()), request(path({0, 0, 1e-3, 0}))};
  const std::vector accepting = {accept_only(too_fast_at_the_end()), waiting[1]};
  const grpc::Status expected = server.create(waiting).status;
  ASSERT_EQ(expected.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(server.list().message.plans_size(), 0) << "whoever waited knows";

  const auto accepted = server.create(accepting);
  ASSERT_TRUE(accepted.status.ok()) << accepted.status.error_message();
  const std::string name = accepted.message.name();
  ASSERT_TRUE(eventually([&] { return !server.get(name).status.ok(); }));
  for (const grpc::Status& status :
       {server.get(name).status, server.create(waiting).status, server.create(accepting).status,
        server.stream(setpoints(name, 1)).status, server.corners(name).status}) {
    EXPECT_EQ(status.error_code(), expected.error_code());
    EXPECT_EQ(status.error_message(), expected.error_message());
    EXPECT_EQ(violations(status), violations(expected));
  }
  ASSERT_EQ(server.list().message.plans_size(), 1);
  EXPECT_EQ(server.list().message.plans(0).state(), v1::PLAN_STATE_REFUSED);
  EXPECT_TRUE(server.remove(name).ok());
  EXPECT_EQ(server.get(name).status.error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(server.list().message.plans_size(), 0);
}

// Or it would be tried again for ever, and nobody would hear of it.
TEST(AcceptOnly, WhatIsDamagedInTheStoreIsRefusedOnce) {
  const kcs::test::TemporaryFolder folder;
  const store::StoreSettings settings{.database = "sqlite:" + (folder.path() / "plans.db").string()};
  {
    store::Store store(settings);
    store.accept("", {.name = "plans/damaged", .machine_name = "", .bytes = "no request"});
    store.release();
  }
  TestServer server({.store = settings});
  Answer<v1::Plan> found;
  ASSERT_TRUE(eventually([&] {
    found = server.get("plans/damaged");
    return !found.status.ok();
  }));
  EXPECT_EQ(found.status.error_code(), grpc::StatusCode::INTERNAL) << found.status.error_message();
  EXPECT_EQ(server.list().message.plans(0).state(), v1::PLAN_STATE_REFUSED);
  EXPECT_TRUE(server.remove("plans/damaged").ok());
}

TEST(AcceptOnly, WhatIsTooLargeSinceTheServersCapsWereLoweredIsRefused) {
  const kcs::test::TemporaryFolder folder;
  const store::StoreSettings settings{.database = "sqlite:" + (folder.path() / "plans.db").string()};
  std::string name;
  {
    TestServer server({.planning_threads = 1, .store = settings});
    const auto accepted = server.create(join(accept_only(blended()), endless_path()));
    ASSERT_TRUE(accepted.status.ok()) << accepted.status.error_message();
    name = accepted.message.name();
  }
  TestServer server({.caps = {.points_per_plan = 1000}, .store = settings});
  Answer<v1::Plan> found;
  ASSERT_TRUE(eventually([&] {
    found = server.get(name);
    return !found.status.ok();
  }));
  EXPECT_EQ(found.status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_NE(found.status.error_message().find("points_per_plan = 1000"), std::string::npos)
      << found.status.error_message();
}

TEST(AcceptOnly, RefusesAtOnceWhatNeedsNoPlanning) {
  TestServer server;
  EXPECT_TRUE(refuses_field(server.create({accept_only(options()), request(path({0, 0, 10, 0}, -1))}).status,
                            "path.feed_mm_s, segment 0"));
  EXPECT_EQ(server.list().message.plans_size(), 0);
  auto late = request(right_angle());
  late.set_accept_only(true);
  EXPECT_TRUE(refuses_field(server.create({request(options()), late}).status, "accept_only"));
}

TEST(AcceptOnly, IsOverWhenThePlanIsDeletedWhileItIsPlanned) {
  TestServer server({.planning_threads = 1, .caps = {.client_waiting = 0}});  // is busy as long as it plans
  const auto accepted = server.create(join(accept_only(blended()), endless_path()));
  ASSERT_TRUE(accepted.status.ok()) << accepted.status.error_message();
  const std::vector other = {request(options()), request(right_angle())};
  EXPECT_EQ(server.create(other).status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  ASSERT_TRUE(server.remove(accepted.message.name()).ok());
  EXPECT_TRUE(eventually([&] { return server.create(other).status.ok(); }));
  EXPECT_EQ(server.get(accepted.message.name()).status.error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(server.list().message.plans_size(), 1);
}

TEST(AcceptOnly, LeavesNothingOfARequestThatTheServerHasNoRoomFor) {
  TestServer server({.planning_threads = 1, .caps = {.client_waiting = 0}});
  const auto busy = server.create(join(accept_only(blended()), endless_path()));
  ASSERT_TRUE(busy.status.ok()) << busy.status.error_message();
  EXPECT_EQ(server.create({accept_only(options()), request(right_angle())}).status.error_code(),
            grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_EQ(server.list().message.plans_size(), 1);
  EXPECT_TRUE(server.remove(busy.message.name()).ok());
}

}  // namespace
}  // namespace kcs::service::test
