// Between the library's structs and the messages of the contract. Used inside the library alone.
#pragma once

#include <cstddef>

#include "client/sdk/live_stream.h"
#include "client/sdk/plan.h"
#include "client/sdk/plan_list.h"
#include "client/sdk/setpoint_stream.h"
#include "kcs/v1/planning.pb.h"

namespace kcs::client {

// Small enough to keep memory low and to stay far below gRPC's largest message of 4 MiB.
inline constexpr std::size_t kGcodeBytesPerMessage = 1 << 18;
inline constexpr std::size_t kPointsPerMessage = 8192;

v1::PlanOptions to_message(const PlanOptions& options);
v1::LiveOutput to_message(const LiveOptions& options);
v1::Priority to_message(Priority priority);
v1::PlanFilter to_message(const PlanFilter& filter);
v1::StreamSetpointsRequest to_message(const std::string& plan, const StreamOptions& options);

// How many points a path with `axes` numbers a point has. Throws Error if its arrays do not fit them.
std::size_t count_points(const PointPath& path, std::size_t axes);

// The points [first, first + count) of a path with `axes` numbers a point, and what belongs to them.
v1::PathChunk to_message(const PointPath& path, std::size_t axes, std::size_t first, std::size_t count);

Machine from_message(const v1::Machine& message);
Plan from_message(const v1::Plan& message);
PlanProgress from_message(const v1::PlanProgress& message);
Corner from_message(const v1::Corner& message);

// Fills `batch`, reusing its memory.
void from_message(const v1::SetpointBatch& message, SetpointBatch& batch);

}  // namespace kcs::client
