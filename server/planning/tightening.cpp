#include "server/planning/tightening.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "server/motion/verifier.h"
#include "server/planning/motion_bounds.h"

namespace kcs::planning {
namespace {

// How often, at most; when the time may be less by so little only, that ends it.
constexpr int kTimes = 8;
constexpr double kSteady = 2e-3;
// Fewer pieces leave no freedom.
constexpr std::size_t kFewestPieces = 8;
// The share of the tolerance that is taken. Bounds are looked at step by step, the tolerance is kept everywhere: around
// what left it, so many steps on either side, the share becomes less by this factor.
constexpr double kShare = 0.985, kCloser = 0.94;
constexpr std::size_t kAround = 2;

double square(double value) { return value * value; }

// Three points of the same place, speed and acceleration with steps so many times as long.
void change_steps(double longer, const std::array<Vector*, 3>& points) {
  const Vector bend = *points[2] - 2 * *points[1] + *points[0], move = longer * (*points[2] - *points[0]) / 2;
  *points[1] += (1 - square(longer)) / 6 * bend;
  *points[0] = *points[1] - move + square(longer) / 2 * bend;
  *points[2] = *points[1] + move + square(longer) / 2 * bend;
}

}  // namespace

Tightening::Tightening(const StretchPath& path, const motion::AxisLimits& limits, const std::stop_token& stop)
    : path_(path), limits_(limits), stop_(stop) {}

TimeSpline Tightening::run(const TimeSpline& spline, std::span<const StretchPiece> settled) {
  TimeSpline best = spline;
  if (spline.pieces() < kFewestPieces) return best;
  spline_ = spline;
  shares_.begin(path_, settled, stop_);
  shares_of_tolerance_.assign(spline.points.size(), kShare);
  for (int i = 0; i < kTimes; ++i) {
    bound_motion(path_, limits_, spline_, shares_of_tolerance_, fit_);
    if (!fit_.solve(stop_)) break;
    spline_.points.assign(fit_.points().begin(), fit_.points().end());
    set_step(spline_.step * fit_.longer());
    if (keeps_everything()) {
      if (spline_.step < best.step) best = spline_;
      if (1 - fit_.longer() < kSteady) break;
    } else {
      look_closer();
    }
  }
  return best;
}

bool Tightening::keeps_everything() {
  legs_.resize(spline_.ways.size());
  std::size_t leg = path_.leg_at(spline_.ways.front());
  for (std::size_t i = 0; i < legs_.size(); ++i) legs_[i] = leg = path_.leg_at(spline_.ways[i], leg);
  shares_.measure(path_, limits_, spline_, legs_, false);
  return shares_.slower() <= 1 - motion::kRoundingShare && shares_.largest_place() <= 1 &&
         shares_.verify_places(path_, limits_, spline_);
}

void Tightening::look_closer() {
  const auto& place = shares_.place();
  for (std::size_t i = 0; i < place.size(); ++i) {
    if (place[i] <= 1) continue;
    const std::size_t from = std::max(i, kAround) - kAround, to = std::min(place.size(), i + kAround + 1);
    for (std::size_t k = from; k < to; ++k) shares_of_tolerance_[k] *= kCloser;
  }
}

// The ends stay where and as fast as they are.
void Tightening::set_step(double step) {
  const double longer = step / spline_.step;
  auto& points = spline_.points;
  auto& ways = spline_.ways;
  const std::size_t size = points.size();
  for (const std::size_t first : {std::size_t{0}, size - 3}) {
    change_steps(longer, {&points[first], &points[first + 1], &points[first + 2]});
    ways[first] = ways[first + 1] - longer * (ways[first + 1] - ways[first]);
    ways[first + 2] = ways[first + 1] + longer * (ways[first + 2] - ways[first + 1]);
  }
  spline_.step = step;
}

}  // namespace kcs::planning
