// WatchPlan: how far a plan has come, to its end.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "tests/service/kept_plans.h"
#include "tests/service/secure_client.h"

namespace kcs::service::test {
namespace {

TEST(WatchPlan, TellsOfProgressUntilThePlanIsReady) {
  TestServer server({.planning_threads = 1});
  const auto accepted = server.create({accept_only(options()), request(long_path())});
  ASSERT_TRUE(accepted.status.ok()) << accepted.status.error_message();
  const auto progress = server.watch(accepted.message.name());
  ASSERT_TRUE(progress.status.ok()) << progress.status.error_message();
  const auto& told = progress.message;
  ASSERT_GE(told.size(), 2U);

  const auto& last = told.back();
  EXPECT_EQ(last.state(), v1::PLAN_STATE_READY);
  EXPECT_EQ(last.segments_planned(), last.segment_count());
  EXPECT_EQ(server.get(accepted.message.name()).message.summary().segment_count(), last.segment_count());
  EXPECT_TRUE(std::ranges::all_of(told.begin(), told.end() - 1, [](const v1::PlanProgress& step) {
    return step.state() == v1::PLAN_STATE_WAITING || step.state() == v1::PLAN_STATE_PLANNING;
  }));
  EXPECT_TRUE(std::ranges::is_sorted(told, {}, &v1::PlanProgress::segments_planned));
  EXPECT_TRUE(std::ranges::any_of(told, [&last](const v1::PlanProgress& step) {
    return step.state() == v1::PLAN_STATE_PLANNING && step.segments_planned() > 0 &&
           step.segments_planned() < last.segment_count();
  })) << "nothing is told between the beginning and the end";
}

TEST(WatchPlan, EndsWithTheCallThatWaitsForThePlan) {
  using std::chrono::steady_clock;
  std::vector<steady_clock::duration> later;
  for (int round = 0; round < 3; ++round) {  // the longest time tells how busy the machine is
    TestServer server({.planning_threads = 1});
    const auto accepted = server.create({accept_only(options()), request(long_path())});
    ASSERT_TRUE(accepted.status.ok()) << accepted.status.error_message();
    steady_clock::time_point watched;
    std::thread watcher([&] {
      EXPECT_TRUE(server.watch(accepted.message.name()).status.ok());
      watched = steady_clock::now();
    });
    EXPECT_TRUE(server.create({request(options()), request(long_path())}).status.ok());
    const auto made = steady_clock::now();
    watcher.join();
    later.push_back(watched - made);
  }
  std::ranges::sort(later);
  EXPECT_LT(later[1], std::chrono::milliseconds(400));
}

TEST(WatchPlan, TellsHowManyGoBefore) {
  TestServer server({.planning_threads = 1});
  const auto first = server.create(join(accept_only(blended()), endless_path()));
  ASSERT_TRUE(first.status.ok()) << first.status.error_message();
  auto patient = accept_only(options());
  patient.set_priority(v1::PRIORITY_BATCH);  // waits as long as its client has other things to do
  const auto second = server.create({patient, request(right_angle())});
  ASSERT_TRUE(second.status.ok()) << second.status.error_message();

  Call call;
  v1::WatchPlanRequest watched;
  watched.set_name(second.message.name());
  const auto reader = server.stub().WatchPlan(&call, watched);
  v1::PlanProgress progress;
  ASSERT_TRUE(reader->Read(&progress));
  EXPECT_EQ(progress.state(), v1::PLAN_STATE_WAITING);
  EXPECT_EQ(progress.segment_count(), 2U);
  EXPECT_EQ(progress.segments_planned(), 0U);
  ASSERT_TRUE(server.remove(first.message.name()).ok());
  while (reader->Read(&progress)) continue;
  EXPECT_TRUE(reader->Finish().ok());
  EXPECT_EQ(progress.state(), v1::PLAN_STATE_READY);
}

TEST(WatchPlan, OfAReadyOneSaysSoAndEnds) {
  TestServer server;
  const std::string name = server.create({request(options()), request(right_angle())}).message.name();
  const auto progress = server.watch(name);
  EXPECT_TRUE(progress.status.ok());
  ASSERT_EQ(progress.message.size(), 1U);
  EXPECT_EQ(progress.message[0].state(), v1::PLAN_STATE_READY);
  EXPECT_EQ(progress.message[0].segment_count(), 2U);
  EXPECT_EQ(progress.message[0].segments_planned(), 2U);
}

TEST(WatchPlan, OfOneThatIsRefusedEndsWithWhatCreatePlanSays) {
  TestServer server;
  const auto path_of_it = request(path({0, 0, 1e-3, 0}));
  const grpc::Status expected = server.create({request(too_fast_at_the_end()), path_of_it}).status;
  ASSERT_TRUE(refuses_field(expected, "options.end_speed_mm_s"));
  const auto accepted = server.create({accept_only(too_fast_at_the_end()), path_of_it});
  ASSERT_TRUE(accepted.status.ok()) << accepted.status.error_message();
  for (int round = 0; round < 2; ++round) {  // while it is planned, perhaps, and afterwards
    const auto progress = server.watch(accepted.message.name());
    EXPECT_TRUE(refuses_field(progress.status, "options.end_speed_mm_s"));
    EXPECT_EQ(progress.status.error_message(), expected.error_message());
    EXPECT_EQ(violations(progress.status), violations(expected));
    EXPECT_TRUE(std::ranges::none_of(progress.message, [](const v1::PlanProgress& step) {
      return step.state() == v1::PLAN_STATE_READY || step.state() == v1::PLAN_STATE_REFUSED;
    }));
  }
}

TEST(WatchPlan, OfNoneIsRefused) {
  TestServer server;
  EXPECT_EQ(server.watch("plans/none").status.error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_TRUE(refuses_field(server.watch("").status, "name"));
}

TEST(WatchPlan, OfSomebodyElsesIsAnsweredLikeOneThatIsNotThere) {
  TestServer server(with_tokens({known("cam", {security::Role::kPlan}), known("shop", {security::Role::kPlan})}));
  SecureClient cam = client_of(server, "cam");
  SecureClient shop = client_of(server, "shop");
  const std::string name = cam.create().message.name();
  EXPECT_TRUE(cam.watch(name).status.ok());
  EXPECT_EQ(shop.watch(name).status.error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(shop.watch(name).status.error_message(), shop.watch("plans/none").status.error_message());
}

TEST(WatchPlan, EndsWhenThePlanIsDeletedAndWhenTheClientGoes) {
  TestServer server({.planning_threads = 1});
  const auto accepted = server.create(join(accept_only(blended()), endless_path()));
  ASSERT_TRUE(accepted.status.ok()) << accepted.status.error_message();
  v1::WatchPlanRequest watched;
  watched.set_name(accepted.message.name());
  Call left;
  const auto leaving = server.stub().WatchPlan(&left, watched);
  Call call;
  const auto reader = server.stub().WatchPlan(&call, watched);
  v1::PlanProgress progress;
  ASSERT_TRUE(leaving->Read(&progress));
  ASSERT_TRUE(reader->Read(&progress));
  left.TryCancel();
  EXPECT_EQ(leaving->Finish().error_code(), grpc::StatusCode::CANCELLED);
  ASSERT_TRUE(server.remove(accepted.message.name()).ok());
  while (reader->Read(&progress)) EXPECT_NE(progress.state(), v1::PLAN_STATE_READY);
  EXPECT_EQ(reader->Finish().error_code(), grpc::StatusCode::NOT_FOUND);
}

}  // namespace
}  // namespace kcs::service::test
