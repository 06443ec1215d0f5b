#include "server/planning/validation.h"

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "server/planning/invalid_input.h"

namespace kcs::planning {
namespace {

class Validation {
 public:
  // `number` must lie in [low, high]; NaN lies nowhere.
  template <class Field>
  void in_range(const Field& field, double number, double low, double high, const char* unit) {
    if (number >= low && number <= high) return;
    add(field(), fmt::format("is {}; give a number from {} to {} {}", number, low, high, unit));
  }

  void add(std::string field, std::string description) {
    if (violations_.size() < kMaxViolations) violations_.push_back({std::move(field), std::move(description)});
  }

  bool full() const { return violations_.size() == kMaxViolations; }

  void raise() {
    if (!violations_.empty()) throw InvalidInput(std::move(violations_));
  }

 private:
  std::vector<Violation> violations_;
};

void check_axis(Validation& validation, const char* name, const Vector& limit, std::size_t axes, double low,
                double high, const char* unit) {
  for (std::size_t axis = 0; axis < axes; ++axis) {
    validation.in_range([&] { return fmt::format("limits.{}[{}]", name, axis); }, limit[axis], low, high, unit);
  }
}

void check_point(Validation& validation, const std::string& where, const Vector& point, std::size_t axes) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double bound = axis < axes ? range::kCoordinate : 0;
    validation.in_range([&] { return fmt::format("{}, {}", where, "xyz"[axis]); }, point[axis], -bound, bound, "mm");
  }
}

void check_segment(Validation& validation, const Segment& segment, std::size_t index, std::size_t axes) {
  const auto field = [index](const char* name) {
    return [index, name] { return fmt::format("path, segment {}, {}", index, name); };
  };
  if (!(segment.end.array().abs() <= range::kCoordinate).all() || (axes == 2 && segment.end.z() != 0)) {
    check_point(validation, fmt::format("path, segment {}", index), segment.end, axes);
  }
  if (segment.feed != INFINITY) {
    validation.in_range(field("feed"), segment.feed, range::kMinFeed, range::kMaxFeed, "mm/s");
  }
  validation.in_range(field("tolerance"), segment.tolerance, 0, range::kMaxTolerance, "mm");
  validation.in_range(field("dwell"), segment.dwell, 0, range::kMaxDwell, "s");
  validation.in_range(field("marker"), segment.marker.speed, 0, range::kMaxSpindleSpeed, "1/min");
}

void check_ends(Validation& validation, const PathEnds& ends, std::size_t axes) {
  check_point(validation, "path, start", ends.start, axes);
  validation.in_range([] { return "path, start_speed"; }, ends.start_speed, 0, range::kMaxFeed, "mm/s");
  validation.in_range([] { return "path, start_acceleration"; }, ends.start_acceleration, -range::kMaxAcceleration,
                      range::kMaxAcceleration, "mm/s²");
  validation.in_range([] { return "path, end_speed"; }, ends.end_speed, 0, range::kMaxFeed, "mm/s");
}

}  // namespace

void validate(const PlanOptions& options) {
  Validation validation;
  const AxisLimits& limits = options.limits;
  if (limits.axes != 2 && limits.axes != 3) {
    validation.add("limits.axes", fmt::format("is {}; give 2 or 3", limits.axes));
    validation.raise();
  }
  check_axis(validation, "velocity", limits.velocity, limits.axes, range::kMinVelocity, range::kMaxVelocity, "mm/s");
  check_axis(validation, "acceleration", limits.acceleration, limits.axes, range::kMinAcceleration,
             range::kMaxAcceleration, "mm/s²");
  check_axis(validation, "jerk", limits.jerk, limits.axes, range::kMinJerk, range::kMaxJerk, "mm/s³");
  if (options.strategy == CornerStrategy::kOverlapping) {
    validation.add("strategy", "is only reported, never asked for; ask for kAuto, which lets corners overlap");
  }
  validation.raise();
}

void validate(const PathEnds& ends, std::size_t axes) {
  Validation validation;
  check_ends(validation, ends, axes);
  validation.raise();
}

void validate(const Segment& segment, std::size_t index, std::size_t axes) {
  Validation validation;
  check_segment(validation, segment, index, axes);
  validation.raise();
}

void validate(const Toolpath& path, const PlanOptions& options) {
  validate(options);
  Validation validation;
  check_ends(validation, path, options.limits.axes);
  if (path.segments.empty()) validation.add("path", "has no segment; give at least one move");
  for (std::size_t i = 0; i < path.segments.size() && !validation.full(); ++i) {
    check_segment(validation, path.segments[i], i, options.limits.axes);
  }
  validation.raise();
}

}  // namespace kcs::planning
