#include "tests/service/kept_plans.h"

#include <utility>

namespace kcs::service::test {
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

}  // namespace kcs::service::test
