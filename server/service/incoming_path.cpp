#include "server/service/incoming_path.h"

#include <spdlog/fmt/fmt.h>

#include <utility>

#include "server/gcode/cap_reached.h"
#include "server/gcode/options.h"
#include "server/jobs/cap_exceeded.h"

namespace kcs::service {
namespace {

constexpr const char* kRemedy = "send the program in parts";

}  // namespace

IncomingPath::IncomingPath(jobs::RequestOptions options, const PathCaps& caps, gcode::TakeSegment take)
    : options_(std::move(options)), caps_(caps), take_(std::move(take)) {}

void IncomingPath::add(const v1::PathChunk& chunk) {
  if (gcode_) refuse("path", "points and G-code do not mix in one request: send two");
  if (!points_) begin_points();
  const bool is_first = points_->points() == 0;
  const auto& segments = points_->decode(chunk);
  if (is_first && points_->points() > 0) digest_->add(points_->start());
  for (const planning::Segment& segment : segments) {
    digest_->add(segment);
    take_(segment);
  }
}

void IncomingPath::add(std::string_view gcode) {
  if (points_) refuse("gcode", "points and G-code do not mix in one request: send two");
  if (!gcode_) begin_gcode();
  if (gcode.size() > caps_.gcode_bytes - gcode_bytes_) {
    throw jobs::CapExceeded("gcode_bytes", caps_.gcode_bytes, kRemedy);
  }
  gcode_bytes_ += gcode.size();
  digest_->add(gcode);
  within_caps([&] { gcode_->read(gcode); });
}

jobs::RequestRecord IncomingPath::finish() {
  jobs::RequestRecord record;
  if (points_) {
    if (points_->points() < 2) {
      refuse("path.points_mm",
             fmt::format("the path has {} points: give at least two, the start and the end", points_->points()));
    }
  } else if (gcode_) {
    within_caps([&] { gcode_->finish(); });
    record.notices = gcode_->notices();
    record.max_chord_error = gcode_->largest_chord_error();
  } else {
    refuse("path", "is missing or empty: send points or G-code after the options");
  }
  record.name = digest_->finish();
  record.options = options_;
  return record;
}

void IncomingPath::begin_points() {
  if (options_.start) refuse("options.start_mm", "is for G-code: a path of points starts at its first point");
  points_.emplace(options_, caps_.points_per_plan);
  digest_.emplace(options_);
}

void IncomingPath::begin_gcode() {
  if (!options_.start) options_.start = planning::Vector::Zero();
  gcode::Options options{.axes = options_.planning.limits.axes,
                         .start = *options_.start,
                         .feed = options_.feed,
                         .tolerance = options_.tolerance,
                         .max_segments = caps_.points_per_plan,
                         .max_chords = caps_.chords_per_arc};
  if (options_.rapid) options.rapid = *options_.rapid;
  gcode_.emplace(options, take_);
  digest_.emplace(options_);
}

template <typename Read>
void IncomingPath::within_caps(const Read& read) const {
  try {
    read();
  } catch (const gcode::CapReached& reached) {
    const gcode::Cap cap = reached.cap();
    const bool is_of_points = cap.name == "max_segments" || cap.name == "max_chords";  // as set above
    throw jobs::CapExceeded(is_of_points ? "points_per_plan" : cap.name, cap.value, reached.what());
  }
}

}  // namespace kcs::service
