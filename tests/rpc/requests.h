// Requests of the planning service, in few words.
#pragma once

#include <kcs/v1/planning.pb.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace kcs::test {

// The worked example of the paper: F = 100, A = 2500, J = 2e5 on each axis.
v1::PlanOptions options(std::uint32_t axes = 2);
v1::CreatePlanRequest request(const v1::PlanOptions& options);
v1::CreatePlanRequest request(const v1::PathChunk& path);
v1::CreatePlanRequest gcode(std::string_view text);
// Points one after the other, all at the same feed.
v1::PathChunk path(const std::vector<double>& points, double feed = 100);
// Two legs of 10 mm at a right angle, 2 axes.
v1::PathChunk right_angle();
// Moves of 10 mm along one axis, and of 10 mm to and fro along the other; 2 axes.
v1::PathChunk zigzag(int points);
v1::StreamSetpointsRequest setpoints(const std::string& name, double period);

}  // namespace kcs::test
