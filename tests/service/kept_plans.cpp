#include "tests/service/kept_plans.h"

#include <utility>

namespace kcs::service::test {
namespace {

v1::PathChunk zigzag(int points) {
  v1::PathChunk chunk;
  chunk.add_feed_mm_s(100);
  for (int i = 0; i < points; ++i) {
    chunk.add_points_mm(10 * (i % 1000));
    chunk.add_points_mm(10 * (i % 2));
  }
  return chunk;
}

}  // namespace

v1::CreatePlanRequest accept_only(v1::PlanOptions options) {
  v1::CreatePlanRequest message = request(options);
  message.set_accept_only(true);
  return message;
}

v1::PlanOptions too_fast_at_the_end() {
  v1::PlanOptions fast = options();
  fast.set_end_speed_mm_s(99);
  return fast;
}

v1::PathChunk long_path() { return zigzag(40'000); }

std::vector<v1::CreatePlanRequest> endless_path() { return std::vector(9, request(zigzag(100'000))); }

v1::PlanOptions blended() {
  v1::PlanOptions slow = options();
  slow.set_strategy(v1::CORNER_STRATEGY_BLENDED);
  return slow;
}

std::vector<v1::CreatePlanRequest> join(v1::CreatePlanRequest first, std::vector<v1::CreatePlanRequest> rest) {
  rest.insert(rest.begin(), std::move(first));
  return rest;
}

Answer<v1::ListPlansResponse> list(TestServer& server, const v1::ListPlansRequest& request) {
  Answer<v1::ListPlansResponse> answer;
  Call call;
  answer.status = server.stub().ListPlans(&call, request, &answer.message);
  return answer;
}

Answer<std::vector<v1::PlanProgress>> watch(TestServer& server, const std::string& name) {
  Answer<std::vector<v1::PlanProgress>> answer;
  Call call;
  v1::WatchPlanRequest request;
  request.set_name(name);
  const auto reader = server.stub().WatchPlan(&call, request);
  for (v1::PlanProgress progress; reader->Read(&progress);) answer.message.push_back(progress);
  answer.status = reader->Finish();
  return answer;
}

v1::Plan wait_until_ready(TestServer& server, const std::string& name) {
  Answer<v1::Plan> answer;
  EXPECT_TRUE(eventually([&] {
    answer = server.get(name);
    return !answer.status.ok() || answer.message.state() == v1::PLAN_STATE_READY;
  }));
  EXPECT_TRUE(answer.status.ok()) << answer.status.error_message();
  return answer.message;
}

}  // namespace kcs::service::test
