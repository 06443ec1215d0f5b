#include "server/service/upload.h"

#include <utility>

#include "server/service/decode.h"

namespace kcs::service {

void Upload::add(const v1::CreatePlanRequest& message) {
  if (message.priority() != v1::PRIORITY_UNSPECIFIED) {
    if (incoming_) refuse("priority", "came late: send it once, beside the options");
    priority_ = decode_priority(message.priority());
  }
  add_message(message, incoming_, [this](const v1::PlanOptions& options) { begin(options); });
}

void Upload::begin(const v1::PlanOptions& options) {
  const PathCaps caps{.points_per_plan = caps_.points_per_plan,
                      .chords_per_arc = caps_.points_per_plan,
                      .gcode_bytes = caps_.gcode_bytes};
  incoming_.emplace(decode_options(options), caps,
                    [this](const planning::Segment& segment) { request_.path.segments.push_back(segment); });
}

jobs::PlanRequest Upload::finish() {
  if (!incoming_) refuse("options", "the request is empty: send the options first, then the path");
  static_cast<jobs::RequestRecord&>(request_) = incoming_->finish();
  static_cast<planning::PathEnds&>(request_.path) = request_.options.ends(incoming_->start());
  return std::move(request_);
}

}  // namespace kcs::service
