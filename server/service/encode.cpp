#include "server/service/encode.h"

#include <cstddef>
#include <numbers>

#include "server/service/printable.h"

namespace kcs::service {
namespace {

using Numbers = google::protobuf::RepeatedField<double>;

constexpr std::size_t kMostNoticeBytes = 1000;

void encode_vector(const planning::Vector& vector, std::size_t axes, Numbers& numbers) {
  numbers.Assign(vector.data(), vector.data() + axes);
}

v1::ToleranceKind encode_tolerance_kind(planning::ToleranceKind kind) {
  return kind == planning::ToleranceKind::kContourError ? v1::TOLERANCE_KIND_CONTOUR_ERROR
                                                        : v1::TOLERANCE_KIND_CORNER_DISTANCE;
}

v1::CornerStrategy encode_strategy(planning::CornerStrategy strategy) {
  switch (strategy) {
    case planning::CornerStrategy::kAuto:
      return v1::CORNER_STRATEGY_AUTO;
    case planning::CornerStrategy::kInterrupted:
      return v1::CORNER_STRATEGY_INTERRUPTED;
    case planning::CornerStrategy::kUninterrupted:
      return v1::CORNER_STRATEGY_UNINTERRUPTED;
    case planning::CornerStrategy::kExactStop:
      return v1::CORNER_STRATEGY_EXACT_STOP;
    case planning::CornerStrategy::kBlended:
      return v1::CORNER_STRATEGY_BLENDED;
    case planning::CornerStrategy::kOverlapping:
      return v1::CORNER_STRATEGY_OVERLAPPING;
  }
  return v1::CORNER_STRATEGY_UNSPECIFIED;
}

void encode_summary(const Outcome& outcome, std::size_t axes, v1::PlanSummary& message) {
  const planning::Summary& summary = outcome.summary;
  message.set_cycle_time_s(summary.cycle_time);
  message.set_path_length_mm(summary.path_length);
  message.set_segment_count(summary.segments);
  message.set_corner_count(summary.interrupted + summary.uninterrupted + summary.blended + summary.overlapping +
                           summary.exact_stops);
  message.set_interrupted_count(summary.interrupted);
  message.set_uninterrupted_count(summary.uninterrupted);
  message.set_exact_stop_count(summary.exact_stops);
  message.set_blended_count(summary.blended);
  message.set_overlapping_count(summary.overlapping);
  message.set_time_lost_at_corners_s(summary.time_lost_at_corners);
  message.set_dwell_time_s(summary.dwell_time);
  message.set_time_at_feed_s(summary.time_at_feed);
  message.set_max_contour_error_mm(summary.max_contour_error);
  message.set_max_feed_mm_s(summary.max_feed);
  encode_vector(summary.max_velocity, axes, *message.mutable_max_velocity_mm_s());
  encode_vector(summary.max_acceleration, axes, *message.mutable_max_acceleration_mm_s2());
  encode_vector(summary.max_jerk, axes, *message.mutable_max_jerk_mm_s3());
  message.set_phase_count(outcome.phases);
  message.set_marker_count(summary.markers);
  encode_vector(outcome.start, axes, *message.mutable_start_mm());
  encode_vector(outcome.end, axes, *message.mutable_end_mm());
}

}  // namespace

void encode_limits(const planning::AxisLimits& limits, v1::Machine& machine) {
  machine.set_axes(static_cast<std::uint32_t>(limits.axes));
  encode_vector(limits.velocity, limits.axes, *machine.mutable_velocity_mm_s());
  encode_vector(limits.acceleration, limits.axes, *machine.mutable_acceleration_mm_s2());
  encode_vector(limits.jerk, limits.axes, *machine.mutable_jerk_mm_s3());
}

void encode_options(const jobs::RequestOptions& options, v1::PlanOptions& message) {
  const planning::AxisLimits& limits = options.planning.limits;
  v1::Machine& machine = *message.mutable_machine();
  machine.set_name(options.machine_name);
  encode_limits(limits, machine);
  if (options.rapid) machine.set_rapid_mm_s(*options.rapid);
  message.set_tolerance_mm(options.tolerance);
  message.set_tolerance_kind(encode_tolerance_kind(options.planning.tolerance_kind));
  message.set_strategy(encode_strategy(options.planning.strategy));
  if (options.feed) message.set_feed_mm_s(*options.feed);
  if (options.start) encode_vector(*options.start, limits.axes, *message.mutable_start_mm());
  message.set_start_speed_mm_s(options.start_speed);
  message.set_start_acceleration_mm_s2(options.start_acceleration);
  message.set_end_speed_mm_s(options.end_speed);
}

void encode_plan(const jobs::RequestRecord& request, const Outcome& outcome, v1::Plan& message) {
  message.set_name(request.name);
  encode_options(request.options, *message.mutable_options());
  encode_summary(outcome, request.options.planning.limits.axes, *message.mutable_summary());
  message.mutable_summary()->set_max_chord_error_mm(request.max_chord_error);
  for (const gcode::Notice& notice : request.notices) {
    v1::Notice& entry = *message.add_notices();
    entry.set_line(notice.line);
    entry.set_text(printable(notice.text, kMostNoticeBytes));
    entry.set_count(notice.count);
  }
}

void encode_plan(const jobs::KeptPlan& kept, v1::Plan& message) {
  const planning::Plan& plan = kept.plan;
  encode_plan(kept, {plan.summary, plan.trajectory.size(), plan.start, plan.trajectory.final_state().position},
              message);
}

void encode_marker(const planning::Marker& marker, v1::Marker& message) {
  message.set_kind(static_cast<v1::MarkerKind>(marker.kind));
  message.set_value(marker.speed);
}

void encode_corner(const planning::Corner& corner, const planning::PlanOptions& options, v1::Corner& message) {
  const bool contour = options.tolerance_kind == planning::ToleranceKind::kContourError;
  message.set_segment(corner.segment);
  message.set_line(corner.line);
  message.set_angle_deg(corner.angle * 180 / std::numbers::pi);
  message.set_strategy(encode_strategy(corner.strategy));
  message.set_speed_mm_s(corner.speed);
  message.set_boundary_acceleration_mm_s2(corner.boundary_acceleration);
  message.set_duration_s(corner.duration);
  message.set_deviation_mm(contour ? corner.contour_error : corner.corner_distance);
  message.set_time_lost_s(corner.time_lost);
  encode_vector(corner.point, options.limits.axes, *message.mutable_point_mm());
  message.set_corner_distance_mm(corner.corner_distance);
  message.set_contour_error_mm(corner.contour_error);
  message.set_dwell_s(corner.dwell);
}

}  // namespace kcs::service
