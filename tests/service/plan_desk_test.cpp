#include "server/jobs/plan_desk.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

#include "server/jobs/cap_exceeded.h"
#include "server/planning/invalid_input.h"

namespace kcs::jobs {
namespace {

PlanRequest right_angle(const std::string& name) {
  PlanRequest request{{.name = name}};
  planning::AxisLimits& limits = request.options.planning.limits;
  limits.axes = 2;
  limits.velocity = {100, 100, 0};
  limits.acceleration = {2500, 2500, 0};
  limits.jerk = {2e5, 2e5, 0};
  request.path.segments = {{.end = {10, 0, 0}, .feed = 100, .tolerance = 0.01},
                           {.end = {10, 10, 0}, .feed = 100, .tolerance = 0.01}};
  return request;
}

// Takes a few tenths of a second to plan.
PlanRequest large(const std::string& name) {
  PlanRequest request = right_angle(name);
  for (int i = 0; i < 20'000; ++i) {
    request.path.segments.push_back({.end = {10.0 * i, 10.0 * (i % 2), 0}, .feed = 100, .tolerance = 0.01});
  }
  return request;
}

TEST(PlanDesk, PlansARequestThatComesManyTimesAtOnceOnlyOnce) {
  PlanDesk desk({.threads = 1, .queue_length = 100, .stored_plans = 10, .stored_bytes = 1 << 30});
  const auto before = desk.submit(large("plans/before"));  // the others have to wait, so that they meet
  constexpr int kClients = 16;
  std::vector<PlanPointer> plans(kClients);
  {
    std::vector<std::thread> clients;
    clients.reserve(kClients);
    for (PlanPointer& plan : plans) {
      clients.emplace_back([&desk, &plan] { plan = desk.submit(right_angle("plans/a")).get(); });
    }
    for (std::thread& client : clients) client.join();
  }
  // A second planning would have made a second object.
  for (const PlanPointer& plan : plans) EXPECT_EQ(plan, plans.front());
  EXPECT_EQ(desk.store().find("plans/a"), plans.front());
}

TEST(PlanDesk, FailureReachesEveryoneAndIsNotKept) {
  PlanDesk desk({.threads = 1, .queue_length = 10, .stored_plans = 10, .stored_bytes = 1 << 20});
  PlanRequest bad = right_angle("plans/b");
  bad.path.segments[1].feed = -1;
  EXPECT_THROW(desk.submit(bad).get(), planning::InvalidInput);
  EXPECT_EQ(desk.store().find("plans/b"), nullptr);
  EXPECT_NE(desk.submit(right_angle("plans/b")).get(), nullptr);
}

TEST(PlanDesk, FullQueueRefusesAndRecovers) {
  PlanDesk desk({.threads = 1, .queue_length = 0, .stored_plans = 1000, .stored_bytes = 1 << 30});
  const auto first = desk.submit(large("plans/large"));
  EXPECT_THROW(desk.submit(right_angle("plans/small")), CapExceeded);
  EXPECT_NE(first.get(), nullptr);
  EXPECT_EQ(desk.submit(large("plans/large")).get(), first.get());
}

}  // namespace
}  // namespace kcs::jobs
