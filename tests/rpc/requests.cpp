#include "tests/rpc/requests.h"

namespace kcs::test {

v1::PlanOptions options(std::uint32_t axes) {
  v1::PlanOptions options;
  options.mutable_machine()->set_axes(axes);
  for (std::uint32_t axis = 0; axis < axes; ++axis) {
    options.mutable_machine()->add_velocity_mm_s(100);
    options.mutable_machine()->add_acceleration_mm_s2(2500);
    options.mutable_machine()->add_jerk_mm_s3(2e5);
  }
  return options;
}

v1::CreatePlanRequest request(const v1::PlanOptions& options) {
  v1::CreatePlanRequest message;
  *message.mutable_options() = options;
  return message;
}

v1::CreatePlanRequest request(const v1::PathChunk& path) {
  v1::CreatePlanRequest message;
  *message.mutable_path() = path;
  return message;
}

v1::CreatePlanRequest gcode(std::string_view text) {
  v1::CreatePlanRequest message;
  message.set_gcode(std::string(text));
  return message;
}

v1::PathChunk path(const std::vector<double>& points, double feed) {
  v1::PathChunk chunk;
  chunk.mutable_points_mm()->Add(points.begin(), points.end());
  chunk.add_feed_mm_s(feed);
  return chunk;
}

v1::PathChunk right_angle() { return path({0, 0, 10, 0, 10, 10}); }

v1::PathChunk zigzag(int points) {
  v1::PathChunk chunk;
  chunk.add_feed_mm_s(100);
  for (int i = 0; i < points; ++i) {
    chunk.add_points_mm(10 * (i % 1000));
    chunk.add_points_mm(10 * (i % 2));
  }
  return chunk;
}

v1::StreamSetpointsRequest setpoints(const std::string& name, double period) {
  v1::StreamSetpointsRequest message;
  message.set_name(name);
  message.set_period_s(period);
  return message;
}

}  // namespace kcs::test
