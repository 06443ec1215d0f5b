// Where on a tool path a tool is that was seen at some points only.
#pragma once

#include <cstddef>
#include <vector>

#include "server/planning/toolpath.h"

namespace kcs::bench {

class PathFollower {
 public:
  // tolerance: how far the tool may be from the path, mm; it may cut corners, but neither turn round nor leave out more
  // of the path than some tolerances.
  PathFollower(const planning::Toolpath& path, double tolerance);

  struct Place {
    std::size_t segment = 0;
    double length = 0;    // along the path, mm
    double distance = 0;  // from the path there or a little before, mm
  };

  // The nearest place not before the last one, for a tool that came to `position` since then.
  Place follow(const planning::Vector& position);

  // mm along the path where a segment starts; one more than segments.
  const std::vector<double>& starts() const { return starts_; }

 private:
  Place nearest_on(std::size_t segment, const planning::Vector& position) const;

  const planning::Toolpath& path_;
  const double tolerance_;
  std::vector<double> starts_ = {0};
  planning::Vector position_;
  Place place_;
};

}  // namespace kcs::bench
