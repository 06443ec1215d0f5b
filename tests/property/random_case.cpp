#include "tests/property/random_case.h"

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <numbers>

#include "tests/property/random.h"

namespace kcs::test {
namespace {

using planning::CornerStrategy;
using planning::ToleranceKind;
using planning::Vector;

class Maker : Random {
 public:
  using Random::Random;

  Case make() {
    Case result;
    make_options(result.options);
    make_path(result.path);
    return result;
  }

 private:
  void make_options(planning::PlanOptions& options) {
    axes_ = one_of<std::size_t>({2, 3});
    options.limits.axes = axes_;
    const bool equal = chance(0.4);
    const double spread = equal ? 1 : 10;
    const double v = log_uniform(5, 2000), a = log_uniform(50, 50000), j = a * log_uniform(3, 300);
    for (std::size_t axis = 0; axis < axes_; ++axis) {
      options.limits.velocity[axis] = v * (equal ? 1 : log_uniform(1 / spread, spread));
      options.limits.acceleration[axis] = a * (equal ? 1 : log_uniform(1 / spread, spread));
      options.limits.jerk[axis] = j * (equal ? 1 : log_uniform(1 / spread, spread));
    }
    options.tolerance_kind = one_of({ToleranceKind::kContourError, ToleranceKind::kCornerDistance});
    options.strategy = one_of({CornerStrategy::kAuto, CornerStrategy::kAuto, CornerStrategy::kInterrupted,
                               CornerStrategy::kUninterrupted, CornerStrategy::kExactStop});
    feed_ = log_uniform(0.1, 2000);
    tolerance_ = log_uniform(1e-4, 1);
  }

  void make_path(planning::Toolpath& path) {
    const double offset = one_of({0.0, 10.0, 1000.0, 1e6});
    for (std::size_t axis = 0; axis < axes_; ++axis) path.start[axis] = uniform(-offset, offset);
    // Each path has lengths of its own: all much alike, or mixed over decades.
    const double shortest = log_uniform(1e-3, 1e4), longest = chance(0.5) ? shortest * 3 : log_uniform(shortest, 1e4);
    const bool changing_feeds = chance(0.5), changing_tolerances = chance(0.3);
    const double stops = one_of({0.0, 0.0, 0.1});
    Vector direction = any_direction();
    Vector at = path.start;
    const std::uint64_t count = 1 + bits() % 40;
    const bool equal_pieces = chance(0.1), back_to_zero = chance(0.05);
    for (std::uint64_t i = 0; i < count; ++i) {
      planning::Segment segment;
      if (!equal_pieces) direction = turned(direction);
      if (equal_pieces) {  // of one oblique line
        at = path.start + direction * (shortest * static_cast<double>(i + 1) / static_cast<double>(count));
      } else if (back_to_zero && i % 2 == 1) {
        at = Vector::Zero();
      } else if (!chance(0.02)) {
        at += direction * log_uniform(shortest, std::min(longest, 1e4));
      }
      segment.end = at;
      if (changing_feeds) feed_ = chance(0.1) ? INFINITY : log_uniform(0.1, 2000);
      segment.feed = feed_;
      if (changing_tolerances) tolerance_ = chance(0.1) ? 0 : log_uniform(1e-4, 1);
      segment.tolerance = tolerance_;
      segment.stop = chance(stops);
      if (chance(stops)) segment.dwell = uniform(0, 2);
      segment.line = static_cast<std::uint32_t>(i + 1);
      path.segments.push_back(segment);
    }
  }

  Vector any_direction() {
    while (true) {
      Vector direction = Vector::Zero();
      for (std::size_t axis = 0; axis < axes_; ++axis) direction[axis] = uniform(-1, 1);
      if (direction.norm() > 0.1) return direction.normalized();
    }
  }

  // `direction` after a corner.
  Vector turned(const Vector& direction) {
    const double angle =
        one_of({0.0, std::numbers::pi, log_uniform(1e-9, 1), uniform(0, std::numbers::pi), uniform(0, std::numbers::pi),
                std::numbers::pi - log_uniform(1e-9, 1), std::numbers::pi / 2});
    if (chance(0.1)) {  // along an axis
      Vector along_axis = Vector::Zero();
      along_axis[static_cast<Eigen::Index>(bits() % axes_)] = one_of({-1.0, 1.0});
      return along_axis;
    }
    Vector aside = any_direction();
    aside -= aside.dot(direction) * direction;
    if (aside.norm() < 1e-3) return direction;
    return (std::cos(angle) * direction + std::sin(angle) * aside.normalized()).normalized();
  }

  std::size_t axes_ = 3;
  double feed_ = 0;
  double tolerance_ = 0;
};

std::string text(const Vector& vector) { return fmt::format("({}, {}, {})", vector.x(), vector.y(), vector.z()); }

}  // namespace

Case random_case(std::uint64_t seed) { return Maker(seed).make(); }

std::string describe(const Case& problem) {
  const auto& options = problem.options;
  std::string result = fmt::format("axes {}, v {}, a {}, j {}, kind {}, strategy {}\nstart {}\n", options.limits.axes,
                                   text(options.limits.velocity), text(options.limits.acceleration),
                                   text(options.limits.jerk), static_cast<int>(options.tolerance_kind),
                                   static_cast<int>(options.strategy), text(problem.path.start));
  for (const auto& segment : problem.path.segments) {
    result += fmt::format("to {} feed {} tolerance {} stop {} dwell {}\n", text(segment.end), segment.feed,
                          segment.tolerance, segment.stop, segment.dwell);
  }
  return result;
}

}  // namespace kcs::test
