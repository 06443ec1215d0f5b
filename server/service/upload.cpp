#include "server/service/upload.h"

#include <utility>

#include "server/service/decode.h"

namespace kcs::service {

void Upload::add(const v1::CreatePlanRequest& message) {
  take_manner(message);
  add_message(message, incoming_, [this](const v1::PlanOptions& options) { begin(options); });
  uploaded_.gcode += message.gcode();
}

// What is no part of the plan: how it is to be made.
void Upload::take_manner(const v1::CreatePlanRequest& message) {
  if (message.priority() != v1::PRIORITY_UNSPECIFIED) {
    if (incoming_) refuse("priority", "came late: send it once, beside the options");
    uploaded_.priority = decode_priority(message.priority());
  }
  if (message.accept_only()) {
    if (incoming_) refuse("accept_only", "came late: send it once, beside the options");
    uploaded_.accept_only = true;
  }
}

void Upload::begin(const v1::PlanOptions& options) {
  const PathCaps caps{.points_per_plan = caps_.points_per_plan,
                      .chords_per_arc = caps_.points_per_plan,
                      .gcode_bytes = caps_.gcode_bytes};
  incoming_.emplace(decode_options(options), caps,
                    [this](const planning::Segment& segment) { uploaded_.request.path.segments.push_back(segment); });
}

Uploaded Upload::finish() {
  if (!incoming_) refuse("options", "the request is empty: send the options first, then the path");
  jobs::PlanRequest& request = uploaded_.request;
  static_cast<jobs::RequestRecord&>(request) = incoming_->finish();
  static_cast<planning::PathEnds&>(request.path) = request.options.ends(incoming_->start());
  return std::move(uploaded_);
}

}  // namespace kcs::service
