#include "tests/unit/jobs/requests.h"

namespace kcs::jobs::test {
namespace {

PlanRequest zigzag(const std::string& name, std::size_t segments) {
  PlanRequest request = right_angle(name);
  for (std::size_t i = 0; i < segments; ++i) {
    request.path.segments.push_back(
        {.end = {10.0 * static_cast<double>(i % 1000), 10.0 * static_cast<double>(i % 2), 0},
         .feed = 100,
         .tolerance = 0.01});
  }
  return request;
}

}  // namespace

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

PlanRequest large(const std::string& name) { return zigzag(name, 20'000); }

PlanRequest endless(const std::string& name) { return zigzag(name, 400'000); }

}  // namespace kcs::jobs::test
