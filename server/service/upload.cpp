#include "server/service/upload.h"

#include <utility>

#include "server/gcode/cap_reached.h"
#include "server/gcode/options.h"
#include "server/jobs/cap_exceeded.h"
#include "server/service/decode.h"
#include "server/service/violations.h"

namespace kcs::service {
void Upload::add(const v1::CreatePlanRequest& message) {
  using Content = v1::CreatePlanRequest::ContentCase;
  const Content content = message.content_case();
  if (content == Content::CONTENT_NOT_SET) refuse("content", "a message is empty: send options, path or gcode");
  if (content == Content::kOptions) return add_options(message.options());
  if (!options_) refuse("options", "the first message must carry the options");
  if (content == Content::kPath) return add_path(message.path());
  add_gcode(message.gcode());
}

void Upload::add_options(const v1::PlanOptions& message) {
  if (options_) refuse("options", "came a second time: send them once, in the first message");
  options_ = decode_options(message);
}

void Upload::add_path(const v1::PathChunk& chunk) {
  if (gcode_) refuse("path", "points and G-code do not mix in one request: send two");
  if (options_->start) refuse("options.start_mm", "is for G-code: a path of points starts at its first point");
  if (!path_) path_.emplace(*options_, caps_.points_per_plan);
  path_->add(chunk);
}

template <typename Read>
void Upload::within_caps(const Read& read) const {
  try {
    read();
  } catch (const gcode::CapReached& reached) {
    const gcode::Cap cap = reached.cap();
    const bool is_of_points = cap.name == "max_segments" || cap.name == "max_chords";  // as set below
    throw jobs::CapExceeded(is_of_points ? "points_per_plan" : cap.name, cap.value, reached.what());
  }
}

void Upload::add_gcode(std::string_view text) {
  if (path_) refuse("gcode", "points and G-code do not mix in one request: send two");
  if (!gcode_) {
    if (!options_->start) options_->start = planning::Vector::Zero();
    gcode::Options options{.axes = options_->planning.limits.axes,
                           .start = *options_->start,
                           .feed = options_->feed,
                           .tolerance = options_->tolerance,
                           .max_segments = caps_.points_per_plan,
                           .max_chords = caps_.points_per_plan};
    if (options_->rapid) options.rapid = *options_->rapid;
    gcode_.emplace(options, gcode_path_);
    digest_.emplace(*options_);
  }
  gcode_bytes_ += text.size();
  if (gcode_bytes_ > caps_.gcode_bytes) {
    throw jobs::CapExceeded("gcode_bytes", caps_.gcode_bytes, "send the program in parts");
  }
  digest_->add(text);
  within_caps([&] { gcode_->read(text); });
}

jobs::PlanRequest Upload::finish() {
  if (!options_) refuse("options", "the request is empty: send the options first, then the path");
  jobs::PlanRequest request;
  if (path_) {
    request.path = path_->finish();
    digest_.emplace(*options_);
    digest_->add(request.path);
  } else if (gcode_) {
    within_caps([&] { gcode_->finish(); });
    request.path = std::move(gcode_path_);
    request.notices = gcode_->notices();
    request.max_chord_error = gcode_->largest_chord_error();
  } else {
    refuse("path", "is missing: send points or G-code after the options");
  }
  request.name = digest_->finish();
  request.options = std::move(*options_);
  return request;
}

}  // namespace kcs::service
