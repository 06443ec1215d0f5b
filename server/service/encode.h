// From the planner's types to the messages of the contract.
#pragma once

#include <kcs/v1/planning.pb.h>

#include <cstdint>

#include "server/jobs/plan_request.h"

namespace kcs::service {

// The axes and their limits.
void encode_limits(const planning::AxisLimits& limits, v1::Machine& machine);

// All of them, with their defaults.
void encode_options(const jobs::RequestOptions& options, v1::PlanOptions& message);

// What became of a request.
struct Outcome {
  planning::Summary summary;
  std::uint64_t phases = 0;                                                           // of the trajectory
  planning::Vector start = planning::Vector::Zero(), end = planning::Vector::Zero();  // of the path, mm
};

void encode_plan(const jobs::RequestRecord& request, const Outcome& outcome, v1::Plan& message);
void encode_plan(const jobs::KeptPlan& kept, v1::Plan& message);

void encode_marker(const planning::Marker& marker, v1::Marker& message);

// Corners in a message.
inline constexpr int kCornersPerBatch = 1000;

// `options`: of the plan that the corner belongs to; they say what its deviation means.
void encode_corner(const planning::Corner& corner, const planning::PlanOptions& options, v1::Corner& message);

}  // namespace kcs::service
