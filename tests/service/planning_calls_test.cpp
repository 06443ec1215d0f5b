// Planning is for those who wait for it: it ends with them, and they take turns.
#include <google/protobuf/util/time_util.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "tests/service/kept_plans.h"
#include "tests/service/live_client.h"

namespace kcs::service::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using std::chrono::steady_clock;

// Planning that goes on until it is done goes on for seconds. On a machine with nothing else to do it stops within 50
// ms (the median is printed); how long it takes on a busy one says nothing about kcsd.
constexpr milliseconds kStopping{750};

void expect_prompt(std::vector<steady_clock::duration> times) {
  std::ranges::sort(times);
  const auto median = times[times.size() / 2];  // the longest ones tell how busy the machine is
  std::printf("median: %.1f ms\n", std::chrono::duration<double, std::milli>(median).count());
  EXPECT_LE(median, kStopping);
}

// Planning is given up long before it would have ended.
constexpr seconds kSoon{5};

// A call of CreatePlan whose planning takes so long that nobody waits for it.
class EndlessCall {
 public:
  explicit EndlessCall(TestServer& server, milliseconds deadline = kDeadline) {
    call_.set_deadline(std::chrono::system_clock::now() + deadline);
    writer_ = server.stub().CreatePlan(&call_, &plan_);
    for (const auto& message : join(request(blended()), endless_path())) writer_->Write(message);
    writer_->WritesDone();
  }

  void cancel() { call_.TryCancel(); }
  grpc::Status finish() { return writer_->Finish(); }

 private:
  grpc::ClientContext call_;
  v1::Plan plan_;
  std::unique_ptr<grpc::ClientWriter<v1::CreatePlanRequest>> writer_;
};

ServerOptions one_thread(const Caps& caps = {}) { return {.planning_threads = 1, .caps = caps}; }

// Of the google.rpc.RetryInfo in a refusal; nothing without one.
std::optional<milliseconds> retry_delay(const grpc::Status& status) {
  const auto info = find_detail<google::rpc::RetryInfo>(status);
  if (!info) return {};
  return milliseconds(google::protobuf::util::TimeUtil::DurationToMilliseconds(info->retry_delay()));
}

::testing::AssertionResult is_planned_soon(TestServer& server) {
  const auto began = steady_clock::now();
  const auto answer = server.create({request(options()), request(right_angle())});
  if (answer.status.ok() && steady_clock::now() - began < kSoon) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << answer.status.error_message() << " after "
                                       << std::chrono::duration<double>(steady_clock::now() - began).count() << " s";
}

TEST(PlanningCalls, WhoCancelsFreesTheThreadThatPlansForHim) {
  TestServer server(one_thread());
  EndlessCall call(server);
  std::this_thread::sleep_for(milliseconds(500));  // it plans by now, or is about to
  call.cancel();
  EXPECT_EQ(call.finish().error_code(), grpc::StatusCode::CANCELLED);
  EXPECT_TRUE(is_planned_soon(server));
}

TEST(PlanningCalls, DeadlineThatPassesFreesTheThreadThatPlans) {
  TestServer server(one_thread());
  EndlessCall call(server, milliseconds(1000));
  EXPECT_EQ(call.finish().error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
  EXPECT_TRUE(is_planned_soon(server));
}

// Waits until the server refuses this one. Asks now and then only: the call that keeps it busy would be refused itself
// if it came while it does what is asked here.
::testing::AssertionResult becomes_busy(const std::function<grpc::Status()>& ask, grpc::Status& refused) {
  const auto end = steady_clock::now() + kDeadline;
  do {
    std::this_thread::sleep_for(milliseconds(300));
    refused = ask();
    if (!refused.ok()) return ::testing::AssertionSuccess();
  } while (steady_clock::now() < end);
  return ::testing::AssertionFailure() << "it takes everything on";
}

// A server that takes nothing on as long as it plans.
class BusyOrFree {
 public:
  TestServer& server() { return server_; }

  // Asks for another plan every time: one that is kept waits for nothing.
  grpc::Status ask() { return server_.create({request(options()), request(path({0, 0, 10, 0, 10, ++side_}))}).status; }
  bool is_free() { return ask().ok(); }
  ::testing::AssertionResult becomes_busy(grpc::Status& refused) {
    return test::becomes_busy([this] { return ask(); }, refused);
  }

 private:
  TestServer server_{one_thread({.client_waiting = 0})};
  double side_ = 10;
};

TEST(PlanningCalls, CancellingFreesTheThreadAtOnce) {
  constexpr std::size_t kCalls = 5;
  BusyOrFree it;
  grpc::Status refused;
  std::vector<steady_clock::duration> times;
  while (times.size() < kCalls) {
    EndlessCall call(it.server());
    ASSERT_TRUE(it.becomes_busy(refused));
    const auto cancelled = steady_clock::now();
    call.cancel();
    ASSERT_TRUE(eventually([&] { return it.is_free(); }));
    times.push_back(steady_clock::now() - cancelled);
    call.finish();
  }
  expect_prompt(times);
}

// A path that PlanLive plans in one go, for seconds.
v1::PathChunk many_legs_within_the_tolerance() {
  v1::PathChunk chunk;
  chunk.add_feed_mm_s(100);
  chunk.add_tolerance_mm(100);
  for (int i = 0; i < 60'000; ++i) {
    chunk.add_points_mm(0.01 * i);
    chunk.add_points_mm(0.001 * (i % 2));
  }
  return chunk;
}

TEST(PlanningCalls, CancellingALiveCallFreesItsPlaceAtOnce) {
  constexpr std::size_t kCalls = 5;
  TestServer server({.caps = {.live_streams = 1}});
  const auto small = live({request(options()), request(right_angle())}, every(0.001));
  const auto large = live({request(options()), request(many_legs_within_the_tolerance())}, every(0.001));
  std::vector<steady_clock::duration> times;
  while (times.size() < kCalls) {
    LiveClient call(server);
    for (const v1::PlanLiveRequest& message : large) ASSERT_TRUE(call.write(message));
    std::this_thread::sleep_for(milliseconds(300));  // it plans by now, or is about to
    const auto cancelled = steady_clock::now();
    call.cancel();
    ASSERT_TRUE(eventually([&] { return LiveClient(server).exchange(small).status.ok(); }));
    times.push_back(steady_clock::now() - cancelled);
    EXPECT_EQ(call.read_all().status.error_code(), grpc::StatusCode::CANCELLED);
  }
  expect_prompt(times);
}

TEST(PlanningCalls, ClientWithTooManyWaitingIsRefusedAndToldWhenToTryAgain) {
  BusyOrFree it;
  EndlessCall call(it.server());
  grpc::Status status;
  ASSERT_TRUE(it.becomes_busy(status));
  EXPECT_EQ(status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_NE(status.error_message().find("client_waiting = 0"), std::string::npos) << status.error_message();
  const auto delay = retry_delay(status);
  ASSERT_TRUE(delay);
  EXPECT_GE(*delay, milliseconds(100));
  call.cancel();
  call.finish();
  EXPECT_TRUE(eventually([&] { return it.is_free(); }));
}

TEST(PlanningCalls, FullQueueTellsWhenToTryAgain) {
  TestServer server(one_thread({.queue_length = 0}));
  EndlessCall call(server);
  double side = 10;
  grpc::Status status;
  ASSERT_TRUE(becomes_busy(
      [&] {
        return server.create({request(options()), request(path({0, 0, 10, 0, 10, ++side}))}).status;
      },
      status));
  EXPECT_EQ(status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_NE(status.error_message().find("queue_length = 0"), std::string::npos) << status.error_message();
  EXPECT_TRUE(retry_delay(status));
  call.cancel();
  call.finish();
}

TEST(PlanningCalls, RequestTooLargeForTheServerIsNotWorthTryingAgain) {
  TestServer server({.caps = {.points_per_plan = 2}});
  const grpc::Status status = server.create({request(options()), request(right_angle())}).status;
  EXPECT_EQ(status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_FALSE(retry_delay(status));
}

TEST(PlanningCalls, InteractiveRequestGoesBeforeALongOneOfTheSameClient) {
  TestServer server(one_thread());
  EndlessCall call(server);
  std::this_thread::sleep_for(milliseconds(500));
  auto urgent = request(options());
  urgent.set_priority(v1::PRIORITY_INTERACTIVE);
  const auto began = steady_clock::now();
  EXPECT_TRUE(server.create({urgent, request(right_angle())}).status.ok());
  EXPECT_LT(steady_clock::now() - began, kSoon);
  call.cancel();
  call.finish();
}

TEST(PlanningCalls, PriorityIsNoPartOfThePlansName) {
  TestServer server;
  auto urgent = request(options());
  urgent.set_priority(v1::PRIORITY_INTERACTIVE);
  EXPECT_EQ(server.create({urgent, request(right_angle())}).message.name(),
            server.create({request(options()), request(right_angle())}).message.name());
}

TEST(PlanningCalls, PriorityThatComesLateOrIsNoneIsRefused) {
  TestServer server;
  auto late = request(right_angle());
  late.set_priority(v1::PRIORITY_BATCH);
  EXPECT_TRUE(refuses_field(server.create({request(options()), late}).status, "priority"));
  auto none = request(options());
  none.set_priority(static_cast<v1::Priority>(17));
  EXPECT_TRUE(refuses_field(server.create({none, request(right_angle())}).status, "priority"));
}

}  // namespace
}  // namespace kcs::service::test
