#include "server/service/live_call.h"

#include <utility>

#include "server/jobs/cap_exceeded.h"
#include "server/service/decode.h"
#include "server/service/encode.h"

namespace kcs::service {

LiveCall::LiveCall(const Caps& caps, SendLive send, std::stop_token stop)
    : caps_(caps), send_(std::move(send)), stop_(std::move(stop)) {}

std::uint64_t LiveCall::add(const v1::PlanLiveRequest& message) {
  const std::uint64_t before = segments_;
  if (incoming_ && message.has_output()) refuse("output", "came late: send it once, beside the options");
  add_message(message, incoming_, [&](const v1::PlanOptions& options) { begin(options, message.output()); });
  return segments_ - before;
}

void LiveCall::begin(const v1::PlanOptions& options, const v1::LiveOutput& output) {
  incoming_.emplace(decode_options(options), PathCaps{.chords_per_arc = caps_.points_per_plan},
                    [this](const planning::Segment& segment) { plan(segment); });
  const planning::PlanOptions& planning = incoming_->options().planning;
  setpoints_.emplace(output, planning.limits.axes, send_);
  if (output.corners()) corners_.emplace(planning, send_);
}

void LiveCall::plan(const planning::Segment& segment) {
  if (!planner_) {
    const jobs::RequestOptions& options = incoming_->options();
    planning::PlanOptions planning = options.planning;
    planning.stop = stop_;
    setpoints_->begin(incoming_->start());
    planner_.emplace(options.ends(incoming_->start()), planning, *this);
  }
  planner_->add(segment);
  if (planner_->waiting() > caps_.look_ahead) {
    throw jobs::CapExceeded(
        "look_ahead", caps_.look_ahead,
        "the path goes on for longer before any of its motion can be settled: send points that lie on "
        "one straight line as one segment");
  }
  ++segments_;
  flush();
}

std::uint64_t LiveCall::finish() {
  const std::uint64_t before = segments_;
  if (!incoming_) refuse("options", "the request is empty: send the options first, then the path");
  const jobs::RequestRecord request = incoming_->finish();
  if (!planner_) refuse("path", "has no segment; give at least one move");
  const planning::Summary summary = planner_->finish();
  const motion::State end = planner_->end_state();
  setpoints_->finish(end);
  flush();
  v1::PlanLiveResponse response;
  encode_plan(request, {summary, phases_, incoming_->start(), end.position}, *response.mutable_plan());
  send_(response);
  return segments_ - before;
}

void LiveCall::flush() {
  setpoints_->flush();
  if (corners_) corners_->flush();
}

void LiveCall::take(const planning::Segment& segment) { setpoints_->add(segment); }

void LiveCall::take(const motion::Phase& phase) {
  ++phases_;
  setpoints_->add(phase);
}

void LiveCall::take(const planning::MarkerAt& marker) { setpoints_->add(marker); }

void LiveCall::take(const planning::Corner& corner) {
  if (corners_) corners_->add(corner);
}

}  // namespace kcs::service
