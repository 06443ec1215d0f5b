#include "client/sdk/messages.h"

#include <fmt/core.h>
#include <google/protobuf/util/time_util.h>

#include <algorithm>
#include <string_view>

#include "client/sdk/error.h"

namespace kcs::client {
namespace {

using google::protobuf::util::TimeUtil;

template <typename T>
std::vector<T> to_vector(const google::protobuf::RepeatedField<T>& field) {
  return {field.begin(), field.end()};
}

template <typename T>
void assign(google::protobuf::RepeatedField<T>& field, const std::vector<T>& values) {
  field.Assign(values.begin(), values.end());
}

// The part of `values` that belongs to the points [first, first + count): the array may have one entry per point, a
// single one for all, or none.
template <typename T>
void assign_part(google::protobuf::RepeatedField<T>& field, const std::vector<T>& values, std::size_t first,
                 std::size_t count) {
  if (values.size() <= 1) return assign(field, values);
  const auto begin = values.begin() + static_cast<std::ptrdiff_t>(std::min(first, values.size()));
  const auto end = values.begin() + static_cast<std::ptrdiff_t>(std::min(first + count, values.size()));
  field.Assign(begin, end);
}

void check_entries(std::string_view name, std::size_t entries, std::size_t points, bool single_allowed) {
  if (entries == 0 || entries == points || (single_allowed && entries == 1)) return;
  throw Error("INVALID_ARGUMENT", fmt::format("{} has {} entries for {} points; give {}one per point, or none", name,
                                              entries, points, single_allowed ? "one for all, " : ""));
}

v1::Machine to_message(const Machine& machine) {
  v1::Machine message;
  message.set_name(machine.name);
  message.set_axes(static_cast<std::uint32_t>(machine.axes));
  assign(*message.mutable_velocity_mm_s(), machine.velocity_mm_s);
  assign(*message.mutable_acceleration_mm_s2(), machine.acceleration_mm_s2);
  assign(*message.mutable_jerk_mm_s3(), machine.jerk_mm_s3);
  if (machine.rapid_mm_s) message.set_rapid_mm_s(*machine.rapid_mm_s);
  return message;
}

v1::ToleranceKind to_message(ToleranceKind kind) {
  return kind == ToleranceKind::kCornerDistance ? v1::TOLERANCE_KIND_CORNER_DISTANCE : v1::TOLERANCE_KIND_CONTOUR_ERROR;
}

v1::CornerStrategy to_message(CornerStrategy strategy) {
  switch (strategy) {
    case CornerStrategy::kAuto:
      return v1::CORNER_STRATEGY_AUTO;
    case CornerStrategy::kInterrupted:
      return v1::CORNER_STRATEGY_INTERRUPTED;
    case CornerStrategy::kUninterrupted:
      return v1::CORNER_STRATEGY_UNINTERRUPTED;
    case CornerStrategy::kExactStop:
      return v1::CORNER_STRATEGY_EXACT_STOP;
    case CornerStrategy::kBlended:
      return v1::CORNER_STRATEGY_BLENDED;
    case CornerStrategy::kOverlapping:
      return v1::CORNER_STRATEGY_OVERLAPPING;
  }
  return v1::CORNER_STRATEGY_UNSPECIFIED;
}

v1::Channel to_message(Channel channel) {
  switch (channel) {
    case Channel::kVelocity:
      return v1::CHANNEL_VELOCITY;
    case Channel::kAcceleration:
      return v1::CHANNEL_ACCELERATION;
    case Channel::kJerk:
      return v1::CHANNEL_JERK;
    case Channel::kPathPosition:
      return v1::CHANNEL_PATH_POSITION;
    case Channel::kSegment:
      return v1::CHANNEL_SEGMENT;
    case Channel::kLine:
      return v1::CHANNEL_LINE;
  }
  return v1::CHANNEL_UNSPECIFIED;
}

CornerStrategy from_message(v1::CornerStrategy strategy) {
  switch (strategy) {
    case v1::CORNER_STRATEGY_INTERRUPTED:
      return CornerStrategy::kInterrupted;
    case v1::CORNER_STRATEGY_UNINTERRUPTED:
      return CornerStrategy::kUninterrupted;
    case v1::CORNER_STRATEGY_EXACT_STOP:
      return CornerStrategy::kExactStop;
    case v1::CORNER_STRATEGY_BLENDED:
      return CornerStrategy::kBlended;
    case v1::CORNER_STRATEGY_OVERLAPPING:
      return CornerStrategy::kOverlapping;
    default:
      return CornerStrategy::kAuto;
  }
}

// Live plans have no state: they are there when they are told.
PlanState from_message(v1::PlanState state) {
  switch (state) {
    case v1::PLAN_STATE_WAITING:
      return PlanState::kWaiting;
    case v1::PLAN_STATE_PLANNING:
      return PlanState::kPlanning;
    case v1::PLAN_STATE_REFUSED:
      return PlanState::kRefused;
    default:
      return PlanState::kReady;
  }
}

v1::PlanState to_message(PlanState state) {
  switch (state) {
    case PlanState::kWaiting:
      return v1::PLAN_STATE_WAITING;
    case PlanState::kPlanning:
      return v1::PLAN_STATE_PLANNING;
    case PlanState::kReady:
      return v1::PLAN_STATE_READY;
    case PlanState::kRefused:
      return v1::PLAN_STATE_REFUSED;
  }
  return v1::PLAN_STATE_UNSPECIFIED;
}

PlanOptions from_message(const v1::PlanOptions& message) {
  PlanOptions options;
  options.machine = client::from_message(message.machine());
  if (message.has_tolerance_mm()) options.tolerance_mm = message.tolerance_mm();
  options.tolerance_kind = message.tolerance_kind() == v1::TOLERANCE_KIND_CORNER_DISTANCE
                               ? ToleranceKind::kCornerDistance
                               : ToleranceKind::kContourError;
  options.strategy = from_message(message.strategy());
  if (message.has_feed_mm_s()) options.feed_mm_s = message.feed_mm_s();
  options.start_mm = to_vector(message.start_mm());
  options.start_speed_mm_s = message.start_speed_mm_s();
  options.start_acceleration_mm_s2 = message.start_acceleration_mm_s2();
  options.end_speed_mm_s = message.end_speed_mm_s();
  return options;
}

Summary from_message(const v1::PlanSummary& message) {
  return {.cycle_time_s = message.cycle_time_s(),
          .path_length_mm = message.path_length_mm(),
          .segment_count = message.segment_count(),
          .corner_count = message.corner_count(),
          .interrupted_count = message.interrupted_count(),
          .uninterrupted_count = message.uninterrupted_count(),
          .exact_stop_count = message.exact_stop_count(),
          .blended_count = message.blended_count(),
          .overlapping_count = message.overlapping_count(),
          .time_lost_at_corners_s = message.time_lost_at_corners_s(),
          .dwell_time_s = message.dwell_time_s(),
          .time_at_feed_s = message.time_at_feed_s(),
          .max_contour_error_mm = message.max_contour_error_mm(),
          .max_chord_error_mm = message.max_chord_error_mm(),
          .max_feed_mm_s = message.max_feed_mm_s(),
          .max_velocity_mm_s = to_vector(message.max_velocity_mm_s()),
          .max_acceleration_mm_s2 = to_vector(message.max_acceleration_mm_s2()),
          .max_jerk_mm_s3 = to_vector(message.max_jerk_mm_s3()),
          .phase_count = message.phase_count(),
          .marker_count = message.marker_count(),
          .start_mm = to_vector(message.start_mm()),
          .end_mm = to_vector(message.end_mm())};
}

void copy_columns(const google::protobuf::RepeatedPtrField<v1::Column>& from, Columns& to) {
  to.resize(static_cast<std::size_t>(from.size()));
  for (std::size_t axis = 0; axis < to.size(); ++axis) {
    const auto& values = from[static_cast<int>(axis)].values();
    to[axis].assign(values.begin(), values.end());
  }
}

}  // namespace

v1::PlanOptions to_message(const PlanOptions& options) {
  v1::PlanOptions message;
  *message.mutable_machine() = to_message(options.machine);
  if (options.tolerance_mm) message.set_tolerance_mm(*options.tolerance_mm);
  message.set_tolerance_kind(to_message(options.tolerance_kind));
  message.set_strategy(to_message(options.strategy));
  if (options.feed_mm_s) message.set_feed_mm_s(*options.feed_mm_s);
  assign(*message.mutable_start_mm(), options.start_mm);
  message.set_start_speed_mm_s(options.start_speed_mm_s);
  message.set_start_acceleration_mm_s2(options.start_acceleration_mm_s2);
  message.set_end_speed_mm_s(options.end_speed_mm_s);
  return message;
}

v1::Priority to_message(Priority priority) {
  switch (priority) {
    case Priority::kBatch:
      return v1::PRIORITY_BATCH;
    case Priority::kNormal:
      return v1::PRIORITY_NORMAL;
    case Priority::kInteractive:
      return v1::PRIORITY_INTERACTIVE;
  }
  return v1::PRIORITY_UNSPECIFIED;
}

v1::PlanFilter to_message(const PlanFilter& filter) {
  const auto timestamp = [](Time time) { return TimeUtil::MicrosecondsToTimestamp(time.time_since_epoch().count()); };
  v1::PlanFilter message;
  if (filter.machine_name) message.set_machine_name(*filter.machine_name);
  if (filter.state) message.set_state(to_message(*filter.state));
  if (filter.created_from) *message.mutable_created_from() = timestamp(*filter.created_from);
  if (filter.created_before) *message.mutable_created_before() = timestamp(*filter.created_before);
  if (filter.cycle_time_at_least_s) message.set_cycle_time_at_least_s(*filter.cycle_time_at_least_s);
  if (filter.cycle_time_at_most_s) message.set_cycle_time_at_most_s(*filter.cycle_time_at_most_s);
  return message;
}

v1::StreamSetpointsRequest to_message(const std::string& plan, const StreamOptions& options) {
  v1::StreamSetpointsRequest message;
  message.set_name(plan);
  message.set_period_s(options.period_s);
  message.set_first_index(options.first_index);
  for (const Channel channel : options.channels) message.add_channels(to_message(channel));
  if (options.batch_size) message.set_batch_size(*options.batch_size);
  if (options.last_index) message.set_last_index(*options.last_index);
  if (options.lead_s) message.set_lead_s(*options.lead_s);
  return message;
}

v1::LiveOutput to_message(const LiveOptions& options) {
  v1::LiveOutput message;
  message.set_period_s(options.period_s);
  for (const Channel channel : options.channels) message.add_channels(to_message(channel));
  message.set_batch_size(options.batch_size);
  message.set_corners(options.corners);
  return message;
}

std::size_t count_points(const PointPath& path, std::size_t axes) {
  const std::size_t points = (path.points_mm.size() + axes - 1) / axes;
  check_entries("feed_mm_s", path.feed_mm_s.size(), points, true);
  check_entries("tolerance_mm", path.tolerance_mm.size(), points, true);
  check_entries("line", path.line.size(), points, false);
  for (const Stop& stopped : path.stops) {
    if (stopped.point < points) continue;
    throw Error("INVALID_ARGUMENT",
                fmt::format("stops names point {}, but the path has {} points, counted from 0", stopped.point, points));
  }
  return points;
}

v1::PathChunk to_message(const PointPath& path, std::size_t axes, std::size_t first, std::size_t count) {
  v1::PathChunk message;
  const auto begin = path.points_mm.begin();
  message.mutable_points_mm()->Assign(
      begin + static_cast<std::ptrdiff_t>(first * axes),
      begin + static_cast<std::ptrdiff_t>(std::min((first + count) * axes, path.points_mm.size())));
  assign_part(*message.mutable_feed_mm_s(), path.feed_mm_s, first, count);
  assign_part(*message.mutable_tolerance_mm(), path.tolerance_mm, first, count);
  assign_part(*message.mutable_line(), path.line, first, count);
  for (const Stop& stop : path.stops) {
    if (stop.point < first || stop.point >= first + count) continue;
    v1::Stop& part = *message.add_stops();
    part.set_point(static_cast<std::uint32_t>(stop.point - first));
    part.set_dwell_s(stop.dwell_s);
  }
  return message;
}

Machine from_message(const v1::Machine& message) {
  Machine machine{.name = message.name(),
                  .axes = message.axes(),
                  .velocity_mm_s = to_vector(message.velocity_mm_s()),
                  .acceleration_mm_s2 = to_vector(message.acceleration_mm_s2()),
                  .jerk_mm_s3 = to_vector(message.jerk_mm_s3()),
                  .rapid_mm_s = {}};
  if (message.has_rapid_mm_s()) machine.rapid_mm_s = message.rapid_mm_s();
  return machine;
}

Plan from_message(const v1::Plan& message) {
  Plan plan{.name = message.name(),
            .options = from_message(message.options()),
            .summary = from_message(message.summary()),
            .notices = {},
            .state = from_message(message.state()),
            .create_time = Time(std::chrono::microseconds(TimeUtil::TimestampToMicroseconds(message.create_time())))};
  for (const v1::Notice& notice : message.notices()) {
    plan.notices.push_back({notice.line(), notice.text(), notice.count()});
  }
  return plan;
}

PlanProgress from_message(const v1::PlanProgress& message) {
  return {.state = from_message(message.state()),
          .requests_ahead = message.requests_ahead(),
          .segment_count = message.segment_count(),
          .segments_planned = message.segments_planned()};
}

Corner from_message(const v1::Corner& message) {
  return {.segment = message.segment(),
          .line = message.line(),
          .angle_deg = message.angle_deg(),
          .strategy = from_message(message.strategy()),
          .speed_mm_s = message.speed_mm_s(),
          .boundary_acceleration_mm_s2 = message.boundary_acceleration_mm_s2(),
          .duration_s = message.duration_s(),
          .deviation_mm = message.deviation_mm(),
          .time_lost_s = message.time_lost_s(),
          .point_mm = to_vector(message.point_mm()),
          .corner_distance_mm = message.corner_distance_mm(),
          .contour_error_mm = message.contour_error_mm(),
          .dwell_s = message.dwell_s()};
}

void from_message(const v1::SetpointBatch& message, SetpointBatch& batch) {
  batch.first_index = message.first_index();
  copy_columns(message.position_mm(), batch.position_mm);
  copy_columns(message.velocity_mm_s(), batch.velocity_mm_s);
  copy_columns(message.acceleration_mm_s2(), batch.acceleration_mm_s2);
  copy_columns(message.jerk_mm_s3(), batch.jerk_mm_s3);
  batch.path_position_mm.assign(message.path_position_mm().begin(), message.path_position_mm().end());
  batch.segment.assign(message.segment().begin(), message.segment().end());
  batch.line.assign(message.line().begin(), message.line().end());
  batch.end_of_path = message.end_of_path();
  batch.setpoint_count = message.setpoint_count();
}

}  // namespace kcs::client
