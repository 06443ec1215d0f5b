#include "server/service/decode.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>

#include "server/planning/range.h"

namespace kcs::service {
namespace {

namespace range = planning::range;
using Numbers = google::protobuf::RepeatedField<double>;

constexpr std::size_t kMostNameBytes = 100;

// One number per axis, each from `low` to `high`.
planning::Vector decode_vector(const std::string& field, const Numbers& numbers, std::size_t axes, double low,
                               double high, const char* unit, Violations& violations) {
  planning::Vector vector = planning::Vector::Zero();
  if (static_cast<std::size_t>(numbers.size()) != axes) {
    violations.add(field, fmt::format("has {} numbers: give {}, one per axis", numbers.size(), axes));
    return vector;
  }
  for (int axis = 0; axis < numbers.size(); ++axis) {
    violations.check_range(fmt::format("{}[{}]", field, axis), numbers[axis], low, high, unit);
    vector[axis] = numbers[axis] + 0.0;  // no −0: it would be the same request with another plan
  }
  return vector;
}

void decode_machine(const v1::Machine& machine, jobs::RequestOptions& decoded, Violations& violations) {
  if (machine.name().size() > kMostNameBytes) {
    violations.add("options.machine.name", fmt::format("is too long: give up to {} bytes", kMostNameBytes));
  }
  if (std::any_of(machine.name().begin(), machine.name().end(),
                  [](unsigned char c) { return c < 0x20 || c == 0x7f; })) {
    violations.add("options.machine.name", "has control characters: give text of one line");
  }
  decoded.machine_name = machine.name();
  if (machine.has_rapid_mm_s()) {
    violations.check_range("options.machine.rapid_mm_s", machine.rapid_mm_s(), range::kMinFeed, range::kMaxFeed,
                           "mm/s");
    decoded.rapid = machine.rapid_mm_s();
  }
  decoded.planning.limits = decode_limits(machine, "options.machine", violations);
}

std::optional<planning::ToleranceKind> decode_tolerance_kind(v1::ToleranceKind kind) {
  switch (kind) {
    case v1::TOLERANCE_KIND_UNSPECIFIED:
    case v1::TOLERANCE_KIND_CONTOUR_ERROR:
      return planning::ToleranceKind::kContourError;
    case v1::TOLERANCE_KIND_CORNER_DISTANCE:
      return planning::ToleranceKind::kCornerDistance;
    default:
      return std::nullopt;
  }
}

std::optional<planning::CornerStrategy> decode_strategy(v1::CornerStrategy strategy) {
  switch (strategy) {
    case v1::CORNER_STRATEGY_UNSPECIFIED:
    case v1::CORNER_STRATEGY_AUTO:
      return planning::CornerStrategy::kAuto;
    case v1::CORNER_STRATEGY_INTERRUPTED:
      return planning::CornerStrategy::kInterrupted;
    case v1::CORNER_STRATEGY_UNINTERRUPTED:
      return planning::CornerStrategy::kUninterrupted;
    case v1::CORNER_STRATEGY_EXACT_STOP:
      return planning::CornerStrategy::kExactStop;
    case v1::CORNER_STRATEGY_BLENDED:
      return planning::CornerStrategy::kBlended;
    default:
      return std::nullopt;
  }
}

// The value, or a violation for a number that the contract does not know.
template <typename Enum>
Enum known_or_refused(const std::string& field, std::optional<Enum> value, int number, Violations& violations) {
  if (!value) violations.add(field, fmt::format("{} is none of its values: use one that the contract names", number));
  return value.value_or(Enum{});
}

}  // namespace

planning::AxisLimits decode_limits(const v1::Machine& machine, const std::string& field, Violations& violations) {
  planning::AxisLimits limits;
  if (machine.axes() != 2 && machine.axes() != 3) {
    violations.add(field + ".axes", fmt::format("is {}: give 2 (X, Y) or 3 (X, Y, Z)", machine.axes()));
    return limits;
  }
  limits.axes = machine.axes();
  limits.velocity = decode_vector(field + ".velocity_mm_s", machine.velocity_mm_s(), limits.axes, range::kMinVelocity,
                                  range::kMaxVelocity, "mm/s", violations);
  limits.acceleration = decode_vector(field + ".acceleration_mm_s2", machine.acceleration_mm_s2(), limits.axes,
                                      range::kMinAcceleration, range::kMaxAcceleration, "mm/s²", violations);
  limits.jerk = decode_vector(field + ".jerk_mm_s3", machine.jerk_mm_s3(), limits.axes, range::kMinJerk,
                              range::kMaxJerk, "mm/s³", violations);
  return limits;
}

jobs::RequestOptions decode_options(const v1::PlanOptions& options) {
  Violations violations;
  jobs::RequestOptions decoded;
  if (options.has_machine()) {
    decode_machine(options.machine(), decoded, violations);
  } else {
    violations.add("options.machine", "is missing: give the machine's axes and their limits");
  }
  if (options.has_tolerance_mm()) {
    violations.check_range("options.tolerance_mm", options.tolerance_mm(), 0, range::kMaxTolerance, "mm");
    decoded.tolerance = options.tolerance_mm();
  }
  decoded.planning.tolerance_kind = known_or_refused(
      "options.tolerance_kind", decode_tolerance_kind(options.tolerance_kind()), options.tolerance_kind(), violations);
  if (options.strategy() == v1::CORNER_STRATEGY_OVERLAPPING) {
    violations.add("options.strategy",
                   "OVERLAPPING is only reported: ask for AUTO, which lets corners overlap where they are near");
  } else {
    decoded.planning.strategy =
        known_or_refused("options.strategy", decode_strategy(options.strategy()), options.strategy(), violations);
  }
  if (options.has_feed_mm_s()) {
    violations.check_range("options.feed_mm_s", options.feed_mm_s(), range::kMinFeed, range::kMaxFeed, "mm/s");
    decoded.feed = options.feed_mm_s();
  }
  violations.check_range("options.start_speed_mm_s", options.start_speed_mm_s(), 0, range::kMaxFeed, "mm/s");
  violations.check_range("options.start_acceleration_mm_s2", options.start_acceleration_mm_s2(),
                         -range::kMaxAcceleration, range::kMaxAcceleration, "mm/s²");
  violations.check_range("options.end_speed_mm_s", options.end_speed_mm_s(), 0, range::kMaxFeed, "mm/s");
  decoded.start_speed = options.start_speed_mm_s() + 0.0;  // no −0
  decoded.start_acceleration = options.start_acceleration_mm_s2() + 0.0;
  decoded.end_speed = options.end_speed_mm_s() + 0.0;
  violations.refuse();
  if (!options.start_mm().empty()) {
    decoded.start = decode_vector("options.start_mm", options.start_mm(), decoded.planning.limits.axes,
                                  -range::kCoordinate, range::kCoordinate, "mm", violations);
  }
  violations.refuse();
  return decoded;
}

jobs::Priority decode_priority(v1::Priority priority) {
  switch (priority) {
    case v1::PRIORITY_BATCH:
      return jobs::Priority::kBatch;
    case v1::PRIORITY_UNSPECIFIED:
    case v1::PRIORITY_NORMAL:
      return jobs::Priority::kNormal;
    case v1::PRIORITY_INTERACTIVE:
      return jobs::Priority::kInteractive;
    default:
      refuse("priority",
             fmt::format("{} is none of its values: use one that the contract names", static_cast<int>(priority)));
  }
}

}  // namespace kcs::service
