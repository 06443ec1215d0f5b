#include "server/service/request_code.h"

#include <kcs/stored/v1/request.pb.h>

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include "server/service/encode.h"
#include "server/service/upload.h"

namespace kcs::service {
namespace {

// Points one after the other; those without a line do not go into one chunk with those that have one.
class ChunkWriter {
 public:
  ChunkWriter(stored::v1::Request& request, std::size_t axes) : request_(request), axes_(axes) {}

  void start(const planning::Vector& point) {
    begin(false);
    add_point(point);
    chunk_->add_feed_mm_s(1);  // not used: nothing leads to the start
    chunk_->add_tolerance_mm(0);
  }

  void add(const planning::Segment& segment) {
    const bool has_line = segment.line > 0;
    if (has_line != has_lines_) begin(has_line);
    add_point(segment.end);
    chunk_->add_feed_mm_s(segment.feed);
    chunk_->add_tolerance_mm(segment.tolerance);
    if (has_line) chunk_->add_line(segment.line);
    if (segment.stop) stay(segment.dwell);
    mark(segment.marker);
  }

  // These are for the last point.
  void mark(const planning::Marker& marker) {
    if (marker.kind == planning::MarkerKind::kNone) return;
    v1::PathMarker& entry = *chunk_->add_markers();
    entry.set_point(static_cast<std::uint32_t>(chunk_->feed_mm_s_size() - 1));
    encode_marker(marker, *entry.mutable_marker());
  }
  void stay(double dwell) {
    v1::Stop& stop = *chunk_->add_stops();
    stop.set_point(static_cast<std::uint32_t>(chunk_->feed_mm_s_size() - 1));
    stop.set_dwell_s(dwell);
  }

 private:
  void begin(bool has_lines) {
    chunk_ = request_.add_path();
    has_lines_ = has_lines;
  }
  void add_point(const planning::Vector& point) {
    for (std::size_t axis = 0; axis < axes_; ++axis) chunk_->add_points_mm(point[static_cast<Eigen::Index>(axis)]);
  }

  stored::v1::Request& request_;
  std::size_t axes_;
  v1::PathChunk* chunk_ = nullptr;
  bool has_lines_ = false;
};

// What happens at the start comes as a segment of no length, without a feed: see PathDecoder.
bool stays_at_start(const planning::Toolpath& path) {
  return !path.segments.empty() && std::isinf(path.segments.front().feed);
}

void write_points(const planning::Toolpath& path, ChunkWriter writer) {
  writer.start(path.start);
  const bool stays = stays_at_start(path);
  if (stays) {
    writer.stay(path.segments[0].dwell);
    writer.mark(path.segments[0].marker);
  }
  for (std::size_t i = stays ? 1 : 0; i < path.segments.size(); ++i) writer.add(path.segments[i]);
}

}  // namespace

std::string encode_request(const jobs::PlanRequest& request, std::string_view gcode) {
  stored::v1::Request stored;
  encode_options(request.options, *stored.mutable_options());
  if (gcode.empty()) {
    write_points(request.path, ChunkWriter(stored, request.options.planning.limits.axes));
  } else {
    stored.set_gcode(gcode.data(), gcode.size());
  }
  return stored.SerializeAsString();
}

jobs::PlanRequest decode_request(const std::string& name, const std::string& bytes, const Caps& caps) {
  stored::v1::Request stored;
  if (!stored.ParseFromString(bytes)) throw std::runtime_error("the stored request of " + name + " is damaged");
  Upload upload(caps);
  v1::CreatePlanRequest message;
  message.mutable_options()->Swap(stored.mutable_options());
  upload.add(message);
  for (v1::PathChunk& chunk : *stored.mutable_path()) {
    message.mutable_path()->Swap(&chunk);
    upload.add(message);
  }
  if (!stored.gcode().empty()) {
    message.mutable_gcode()->swap(*stored.mutable_gcode());
    upload.add(message);
  }
  jobs::PlanRequest request = upload.finish().request;
  if (request.name != name) throw std::runtime_error("the stored request of " + name + " is damaged");
  return request;
}

}  // namespace kcs::service
