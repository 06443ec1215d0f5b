#include "tests/bench/stutter/smooth_stretches.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace kcs::bench {
namespace {

using planning::Vector;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kMostTurn = 15 * kDegree;
constexpr double kRoundedTurn = 2 * kDegree;
constexpr double kMostChange = 0.5;
constexpr std::size_t kFewestSegments = 5;

// Where two segments meet.
struct Joint {
  Vector turn = Vector::Zero();  // along its axis, rad
  double length = 0;             // from the middle of one segment to the middle of the other, mm
  bool stop = false;

  Vector curvature() const { return turn / length; }  // 1/mm
};

std::vector<Joint> joints_of(const planning::Toolpath& path) {
  std::vector<Joint> joints;
  for (std::size_t i = 0; i + 1 < path.segments.size(); ++i) {
    const Vector in = path.segments[i].end - path.start_of(i), out = path.segments[i + 1].end - path.segments[i].end;
    const Vector axis = in.cross(out);
    const double angle = std::atan2(axis.norm(), in.dot(out));
    joints.push_back({angle * axis.stableNormalized(), (in.norm() + out.norm()) / 2, path.segments[i].stop});
  }
  return joints;
}

bool goes_on(const Joint& before, const Joint& joint) {
  const double greater = std::max(before.curvature().norm(), joint.curvature().norm());
  return (joint.turn - before.turn).norm() <= kRoundedTurn ||
         (joint.curvature() - before.curvature()).norm() <= kMostChange * greater;
}

double allowed_at(const Joint& before, const Joint& joint, double acceleration, double jerk) {
  const double change = (joint.curvature() - before.curvature()).norm() / ((before.length + joint.length) / 2);
  return std::min(std::sqrt(acceleration / joint.curvature().norm()), std::cbrt(jerk / change));
}

}  // namespace

std::vector<Stretch> smooth_stretches(const planning::Toolpath& path, double acceleration, double jerk) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::vector<Joint> joints = joints_of(path);
  std::vector<Stretch> stretches(path.segments.size(), Stretch{.first = 1, .last = 0, .allowed = kInfinity});
  const auto smooth = [&](std::size_t i) {
    return !joints[i].stop && joints[i].turn.norm() <= kMostTurn && (i == 0 || goes_on(joints[i - 1], joints[i]));
  };
  for (std::size_t first = 0, last = 0; first < stretches.size(); first = ++last) {
    while (last < joints.size() && smooth(last)) ++last;
    if (last - first + 1 < kFewestSegments) continue;
    for (std::size_t i = first; i <= last; ++i) stretches[i] = {first, last, kInfinity};
    for (std::size_t i = first + 1; i < last; ++i) {
      const double allowed = allowed_at(joints[i - 1], joints[i], acceleration, jerk);
      // The tool slows down a little before the place, and for a little after it.
      for (std::size_t near = i - 1; near <= std::min(i + 2, last); ++near) {
        stretches[near].allowed = std::min(stretches[near].allowed, allowed);
      }
    }
  }
  return stretches;
}

}  // namespace kcs::bench
