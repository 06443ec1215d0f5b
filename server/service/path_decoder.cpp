#include "server/service/path_decoder.h"

#include <spdlog/fmt/fmt.h>

#include <cstddef>
#include <limits>
#include <string>

#include "server/jobs/cap_exceeded.h"
#include "server/planning/range.h"

namespace kcs::service {
namespace {

namespace range = planning::range;
using Numbers = google::protobuf::RepeatedField<double>;

// The field and the place inside it. `point`: index in the whole path.
std::string place(const char* field, std::uint64_t point) {
  return point == 0 ? fmt::format("{}, start", field) : fmt::format("{}, segment {}", field, point - 1);
}

// The number of one point, where a single number may stand for all of them.
double shared_or_own(const Numbers& numbers, int point) { return numbers[numbers.size() == 1 ? 0 : point]; }

bool can_be_switched(v1::MarkerKind kind) {
  switch (kind) {
    case v1::MARKER_KIND_UNSPECIFIED:
    case v1::MARKER_KIND_DWELL_BEGINS:
    case v1::MARKER_KIND_DWELL_ENDS:
      return false;
    default:
      return v1::MarkerKind_IsValid(kind);
  }
}

}  // namespace

const std::vector<planning::Segment>& PathDecoder::decode(const v1::PathChunk& chunk) {
  Violations violations;
  const int axes = static_cast<int>(options_.planning.limits.axes);
  const int points = chunk.points_mm_size() / axes;
  if (static_cast<std::uint64_t>(points) > max_points_ - points_) {
    throw jobs::CapExceeded("points_per_plan", max_points_, "send the program in parts");
  }
  check_sizes(chunk, points, violations);
  violations.refuse();

  segments_.clear();
  for (int point = 0; point < points && !violations.full(); ++point) {
    if (points_ == 0 && point == 0) {
      start_ = decode_point(chunk, point, violations);
    } else {
      segments_.push_back(decode_segment(chunk, point, violations));
    }
  }
  violations.refuse();
  decode_stops(chunk, points, violations);
  decode_markers(chunk, points, violations);
  violations.refuse();
  points_ += static_cast<std::uint64_t>(points);
  return segments_;
}

void PathDecoder::check_sizes(const v1::PathChunk& chunk, int points, Violations& violations) const {
  const std::size_t axes = options_.planning.limits.axes;
  if (static_cast<std::size_t>(chunk.points_mm_size()) % axes != 0) {
    violations.add("path.points_mm", fmt::format("has {} numbers in a chunk, no multiple of the machine's {} axes: "
                                                 "send every point whole",
                                                 chunk.points_mm_size(), axes));
  }
  const auto check = [points, &violations](const char* field, int size, bool may_be_single) {
    if (size == 0 || size == points || (size == 1 && may_be_single)) return;
    violations.add(field, fmt::format("has {} numbers in a chunk of {} points: give one per point{}", size, points,
                                      may_be_single ? ", a single one or none" : " or none"));
  };
  check("path.feed_mm_s", chunk.feed_mm_s_size(), true);
  check("path.tolerance_mm", chunk.tolerance_mm_size(), true);
  check("path.line", chunk.line_size(), false);
  const bool has_segments = points > (points_ == 0 ? 1 : 0);
  if (chunk.feed_mm_s().empty() && !options_.feed && has_segments) {
    violations.add("path.feed_mm_s", "is missing: give one per point or a single one, or set options.feed_mm_s");
  }
}

planning::Vector PathDecoder::decode_point(const v1::PathChunk& chunk, int point, Violations& violations) const {
  const int axes = static_cast<int>(options_.planning.limits.axes);
  planning::Vector vector = planning::Vector::Zero();
  for (int axis = 0; axis < axes; ++axis) {
    const double coordinate = chunk.points_mm(point * axes + axis);
    if (!(coordinate >= -range::kCoordinate && coordinate <= range::kCoordinate)) {
      violations.check_range(place("path.points_mm", points_ + static_cast<std::uint64_t>(point)), coordinate,
                             -range::kCoordinate, range::kCoordinate, "mm");
    }
    vector[axis] = coordinate + 0.0;  // no −0: it would be the same request with another plan
  }
  return vector;
}

planning::Segment PathDecoder::decode_segment(const v1::PathChunk& chunk, int point, Violations& violations) const {
  const std::uint64_t index = points_ + static_cast<std::uint64_t>(point);
  planning::Segment segment;
  segment.end = decode_point(chunk, point, violations);
  if (!chunk.feed_mm_s().empty()) {
    segment.feed = shared_or_own(chunk.feed_mm_s(), point);
    if (!(segment.feed >= range::kMinFeed && segment.feed <= range::kMaxFeed)) {
      violations.check_range(place("path.feed_mm_s", index), segment.feed, range::kMinFeed, range::kMaxFeed, "mm/s");
    }
  }
  segment.feed = options_.feed.value_or(segment.feed);
  segment.tolerance = options_.tolerance;
  if (!chunk.tolerance_mm().empty()) {
    segment.tolerance = shared_or_own(chunk.tolerance_mm(), point);
    if (!(segment.tolerance >= 0 && segment.tolerance <= range::kMaxTolerance)) {
      violations.check_range(place("path.tolerance_mm", index), segment.tolerance, 0, range::kMaxTolerance, "mm");
    }
  }
  if (!chunk.line().empty()) {
    segment.line = chunk.line(point);
    if (segment.line == 0) {
      violations.add(place("path.line", index), "is 0: lines count from 1; leave the array empty if they are unknown");
    }
  }
  return segment;
}

void PathDecoder::decode_stops(const v1::PathChunk& chunk, int points, Violations& violations) {
  for (int i = 0; i < chunk.stops_size() && !violations.full(); ++i) {
    const v1::Stop& stop = chunk.stops(i);
    const std::string field = fmt::format("path.stops[{}]", i);
    if (stop.point() >= static_cast<std::uint32_t>(points)) {
      violations.add(field + ".point",
                     fmt::format("is {} in a chunk of {} points: count from 0 within the chunk", stop.point(), points));
      continue;
    }
    if (!violations.check_range(field + ".dwell_s", stop.dwell_s(), 0, range::kMaxDwell, "s")) continue;
    if (points_ + stop.point() == 0) {
      if (stop.dwell_s() > 0) stay_at_start().dwell = stop.dwell_s();  // the tool rests there anyway
      continue;
    }
    planning::Segment& segment = segment_to(stop.point(), points);
    if (segment.stop) violations.add(field + ".point", fmt::format("{} has a stop already: give one", stop.point()));
    segment.stop = true;
    segment.dwell = stop.dwell_s();
  }
}

void PathDecoder::decode_markers(const v1::PathChunk& chunk, int points, Violations& violations) {
  for (int i = 0; i < chunk.markers_size() && !violations.full(); ++i) {
    const v1::PathMarker& entry = chunk.markers(i);
    const std::string field = fmt::format("path.markers[{}]", i);
    if (entry.point() >= static_cast<std::uint32_t>(points)) {
      violations.add(field + ".point", fmt::format("is {} in a chunk of {} points: count from 0 within the chunk",
                                                   entry.point(), points));
      continue;
    }
    const v1::MarkerKind kind = entry.marker().kind();
    if (!can_be_switched(kind)) {
      violations.add(field + ".marker.kind", fmt::format("{} is nothing to switch: give a command for spindle or "
                                                         "coolant; dwells are stops",
                                                         static_cast<int>(kind)));
      continue;
    }
    if (!violations.check_range(field + ".marker.value", entry.marker().value(), 0, range::kMaxSpindleSpeed,
                                kind == v1::MARKER_KIND_SPINDLE_SURFACE_SPEED ? "m/min" : "1/min")) {
      continue;
    }
    planning::Segment& segment = points_ + entry.point() == 0 ? stay_at_start() : segment_to(entry.point(), points);
    if (segment.marker.kind != planning::MarkerKind::kNone) {
      violations.add(field + ".point", fmt::format("{} has a marker already: give the point again", entry.point()));
    }
    segment.marker = {.speed = static_cast<float>(entry.marker().value() + 0.0),
                      .kind = static_cast<planning::MarkerKind>(kind)};
  }
}

// To do something at the start is a segment of no length.
planning::Segment& PathDecoder::stay_at_start() {
  if (segments_.empty() || segments_.front().feed != std::numeric_limits<double>::infinity()) {
    segments_.insert(segments_.begin(), {.end = start_,
                                         .feed = std::numeric_limits<double>::infinity(),
                                         .tolerance = options_.tolerance,
                                         .stop = true});
  }
  return segments_.front();
}

}  // namespace kcs::service
