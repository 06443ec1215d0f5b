// A tool path from the chunks of points in which a client sends it.
#pragma once

#include <kcs/v1/planning.pb.h>

#include <cstdint>

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

  // Throws planning::InvalidInput with all that is wrong in the chunk; jobs::CapExceeded for too many points.
  void add(const v1::PathChunk& chunk);

  // The whole path. Throws planning::InvalidInput if it has fewer than two points.
  planning::Toolpath finish();

 private:
  // Whether each array has as many entries as the chunk's number of points asks for.
  void check_sizes(const v1::PathChunk& chunk, int points, Violations& violations) const;
  planning::Vector decode_point(const v1::PathChunk& chunk, int point, Violations& violations) const;
  planning::Segment decode_segment(const v1::PathChunk& chunk, int point, Violations& violations) const;
  void decode_stops(const v1::PathChunk& chunk, int points, Violations& violations);

  const jobs::RequestOptions& options_;
  const std::uint64_t max_points_;
  planning::Toolpath path_;
  std::uint64_t points_ = 0;  // in the chunks before
};

}  // namespace kcs::service
