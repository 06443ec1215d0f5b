#include "client/cli/json.h"

#include <nlohmann/json.hpp>

#include "client/common/names.h"

namespace kcs::cli {
namespace {

using Json = nlohmann::ordered_json;

Json options_json(const client::PlanOptions& options) {
  Json machine = {{"name", options.machine.name},
                  {"axes", options.machine.axes},
                  {"velocity_mm_s", options.machine.velocity_mm_s},
                  {"acceleration_mm_s2", options.machine.acceleration_mm_s2},
                  {"jerk_mm_s3", options.machine.jerk_mm_s3}};
  if (options.machine.rapid_mm_s) machine["rapid_mm_s"] = *options.machine.rapid_mm_s;
  Json json = {{"machine", machine}};
  if (options.tolerance_mm) json["tolerance_mm"] = *options.tolerance_mm;
  json["tolerance_kind"] = name_of(options.tolerance_kind);
  json["strategy"] = name_of(options.strategy);
  if (options.feed_mm_s) json["feed_mm_s"] = *options.feed_mm_s;
  json["start_mm"] = options.start_mm;
  json["start_speed_mm_s"] = options.start_speed_mm_s;
  json["start_acceleration_mm_s2"] = options.start_acceleration_mm_s2;
  json["end_speed_mm_s"] = options.end_speed_mm_s;
  return json;
}

Json corner_json(const client::Corner& corner) {
  return {{"segment", corner.segment},
          {"line", corner.line},
          {"point_mm", corner.point_mm},
          {"angle_deg", corner.angle_deg},
          {"strategy", name_of(corner.strategy)},
          {"speed_mm_s", corner.speed_mm_s},
          {"boundary_acceleration_mm_s2", corner.boundary_acceleration_mm_s2},
          {"duration_s", corner.duration_s},
          {"dwell_s", corner.dwell_s},
          {"deviation_mm", corner.deviation_mm},
          {"corner_distance_mm", corner.corner_distance_mm},
          {"contour_error_mm", corner.contour_error_mm},
          {"time_lost_s", corner.time_lost_s}};
}

}  // namespace

std::string plan_json(const client::Plan& plan) {
  const client::Summary& summary = plan.summary;
  Json notices = Json::array();
  for (const client::Notice& notice : plan.notices) {
    notices.push_back({{"line", notice.line}, {"text", notice.text}, {"count", notice.count}});
  }
  const Json json = {{"name", plan.name},
                     {"cycle_time_s", summary.cycle_time_s},
                     {"path_length_mm", summary.path_length_mm},
                     {"segment_count", summary.segment_count},
                     {"corner_count", summary.corner_count},
                     {"interrupted_count", summary.interrupted_count},
                     {"uninterrupted_count", summary.uninterrupted_count},
                     {"exact_stop_count", summary.exact_stop_count},
                     {"blended_count", summary.blended_count},
                     {"overlapping_count", summary.overlapping_count},
                     {"time_lost_at_corners_s", summary.time_lost_at_corners_s},
                     {"dwell_time_s", summary.dwell_time_s},
                     {"time_at_feed_s", summary.time_at_feed_s},
                     {"max_contour_error_mm", summary.max_contour_error_mm},
                     {"max_chord_error_mm", summary.max_chord_error_mm},
                     {"max_feed_mm_s", summary.max_feed_mm_s},
                     {"max_velocity_mm_s", summary.max_velocity_mm_s},
                     {"max_acceleration_mm_s2", summary.max_acceleration_mm_s2},
                     {"max_jerk_mm_s3", summary.max_jerk_mm_s3},
                     {"phase_count", summary.phase_count},
                     {"marker_count", summary.marker_count},
                     {"start_mm", summary.start_mm},
                     {"end_mm", summary.end_mm},
                     {"options", options_json(plan.options)},
                     {"notices", notices}};
  return json.dump(2) + "\n";
}

std::string corners_json(const std::vector<client::Corner>& corners) {
  std::string text = "[";
  for (const client::Corner& corner : corners) {
    text += text.size() == 1 ? "\n  " : ",\n  ";
    text += corner_json(corner).dump();
  }
  return text + (corners.empty() ? "]\n" : "\n]\n");
}

}  // namespace kcs::cli
