// A request's path, from the messages in which it comes.
#pragma once

#include <kcs/v1/planning.pb.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

#include "server/gcode/reader.h"
#include "server/jobs/plan_request.h"
#include "server/jobs/request_digest.h"
#include "server/service/path_decoder.h"
#include "server/service/violations.h"

namespace kcs::service {

// How much of a path is taken, at the most; for the caps of the same names (caps.h).
struct PathCaps {
  std::uint64_t points_per_plan = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t chords_per_arc = std::numeric_limits<std::uint64_t>::max();  // counted as points_per_plan as well
  std::uint64_t gcode_bytes = std::numeric_limits<std::uint64_t>::max();
};

// Reads either points or G-code, and checks every message as it comes: what is going to be refused is refused at once.
// What the planner could not take in is never handed on. Memory: that of a message, and of the G-code reader.
class IncomingPath {
 public:
  // `take` gets the segments, in order. Every method throws planning::InvalidInput and jobs::CapExceeded, and what
  // `take` throws.
  IncomingPath(jobs::RequestOptions options, const PathCaps& caps, gcode::TakeSegment take);
  // Its parts refer to each other.
  IncomingPath(const IncomingPath&) = delete;
  IncomingPath& operator=(const IncomingPath&) = delete;

  void add(const v1::PathChunk& chunk);
  void add(std::string_view gcode);

  // After the last piece: the last segment, and what there is to say of the request.
  jobs::RequestRecord finish();

  const jobs::RequestOptions& options() const { return options_; }
  // Where the path starts, mm; known when there is a segment.
  const planning::Vector& start() const { return options_.start ? *options_.start : points_->start(); }

 private:
  void begin_points();
  void begin_gcode();
  // Calls the G-code reader, and names the server's own cap where the reader reaches it.
  template <typename Read>
  void within_caps(const Read& read) const;

  jobs::RequestOptions options_;
  PathCaps caps_;
  gcode::TakeSegment take_;
  // One of these two, from the first piece of the path on.
  std::optional<PathDecoder> points_;
  std::optional<gcode::Reader> gcode_;
  std::optional<jobs::RequestDigest> digest_;
  std::uint64_t gcode_bytes_ = 0;
};

// Hands a message of a request on: its options, which come first and once, to begin(options), which makes `path`;
// pieces of the path to `path`.
template <typename Request, typename Begin>
void add_message(const Request& message, std::optional<IncomingPath>& path, const Begin& begin) {
  switch (message.content_case()) {
    case Request::kOptions:
      if (path) refuse("options", "came a second time: send them once, in the first message");
      return begin(message.options());
    case Request::kPath:
    case Request::kGcode:
      if (!path) refuse("options", "the first message must carry the options");
      return message.has_path() ? path->add(message.path()) : path->add(message.gcode());
    default:
      refuse("content", "a message is empty: send options, path or gcode");
  }
}

}  // namespace kcs::service
