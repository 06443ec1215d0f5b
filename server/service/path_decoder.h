// The segments of a tool path from the chunks of points in which a client sends it.
#pragma once

#include <kcs/v1/planning.pb.h>

#include <cstdint>
#include <vector>

#include "server/jobs/plan_request.h"
#include "server/planning/toolpath.h"
#include "server/service/violations.h"

namespace kcs::service {

// Takes the chunks in their order, checks every number, fills in the options' tolerance and feed.
class PathDecoder {
 public:
  // Keeps a reference to `options`.
  PathDecoder(const jobs::RequestOptions& options, std::uint64_t max_points)
      : options_(options), max_points_(max_points) {}

  // The segments that end in the chunk, valid until the next one. Throws planning::InvalidInput with all that is wrong
  // in the chunk; jobs::CapExceeded for too many points.
  const std::vector<planning::Segment>& decode(const v1::PathChunk& chunk);

  // How many points came.
  std::uint64_t points() const { return points_; }
  // The first of them, mm.
  const planning::Vector& start() const { return start_; }

 private:
  // Whether each array has as many entries as the chunk's number of points asks for.
  void check_sizes(const v1::PathChunk& chunk, int points, Violations& violations) const;
  planning::Vector decode_point(const v1::PathChunk& chunk, int point, Violations& violations) const;
  planning::Segment decode_segment(const v1::PathChunk& chunk, int point, Violations& violations) const;
  void decode_stops(const v1::PathChunk& chunk, int points, Violations& violations);
  void decode_markers(const v1::PathChunk& chunk, int points, Violations& violations);
  planning::Segment& stay_at_start();
  // That ends on a point of the chunk that is not the start.
  planning::Segment& segment_to(std::uint32_t point, int points) {
    return segments_[segments_.size() - static_cast<std::size_t>(points) + point];
  }

  const jobs::RequestOptions& options_;
  const std::uint64_t max_points_;
  planning::Vector start_ = planning::Vector::Zero();
  std::vector<planning::Segment> segments_;  // of the chunk
  std::uint64_t points_ = 0;                 // in the chunks before
};

}  // namespace kcs::service
