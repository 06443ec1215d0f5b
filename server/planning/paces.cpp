#include "server/planning/paces.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace kcs::planning {
namespace {

// The change of a step in one round; a step that is too far away from the path is stretched by this share of the
// excess.
constexpr double kShortest = 0.85, kLongest = 1.15;
constexpr double kStretchAway = 0.15;

// While finishing, what is too fast is slowed down to this share of the feed, inverted: aimed at kAimSpeed, it comes
// down to the feed in ever smaller steps.
constexpr double kAimTooFast = 1.02;
// The same of what is beyond an axis' acceleration, in a brisk search.
constexpr double kAimTooMuch = 1.1;

// Crowded corners take all of the jerk: at the end, only what is hardly inside the limits needs time.
constexpr double kAimCrowded = 1.01;

double square(double value) { return value * value; }
double cube(double value) { return value * value * value; }
double sixth_power(double value) { return square(cube(value)); }

// Of numbers near to 1: good to 1e-4 from 0.6 to 1.6.
double cube_root(double value) { return (5 + value * (35 + value * 14)) / (14 + value * (35 + value * 5)); }

// Of the differences that begin at point j − back; at the ends, of the nearest one.
double share_at(const std::vector<double>& shares, std::size_t j, std::size_t back) {
  return shares[std::min(std::max(j, back) - back, shares.size() - 1)];
}

// The share of a stretch that a step may take beside the ends.
double freedom(std::size_t step, std::size_t steps, const SearchMode& mode) {
  const auto from_start = static_cast<double>(step), from_end = static_cast<double>(steps - 1 - step);
  double share = 1;
  if (from_start < mode.held_start) share = square(from_start / mode.held_start);
  if (from_end < mode.held_end) share = std::min(share, square(from_end / mode.held_end));
  return share;
}

}  // namespace

// A step that takes x times as long has 1/x of the speed, 1/x² of the acceleration and 1/x³ of the jerk: what they ask
// for is compared by its sixth power, so that there is one root to take.
void Paces::set(const MotionShares& shares, const SearchMode& mode) {
  const auto &speed = shares.haste(), &acceleration = shares.acceleration(), &jerk = shares.jerk();
  const std::size_t steps = speed.size();
  const double aim = mode.crowded && mode.finishing ? kAimCrowded : kAimLimits;
  const double aim_beyond = mode.brisk && mode.finishing ? kAimTooMuch : aim;
  const double aim_too_fast = mode.finishing ? kAimTooFast : kAimSpeed;
  const double shortest = sixth_power(kShortest), longest = sixth_power(kLongest);
  wishes_.resize(steps + 4);
  for (std::size_t j = 0; j < steps; ++j) {
    const double fast = speed[j], bent = std::max(share_at(acceleration, j, 1), share_at(acceleration, j, 0)),
                 jerky = std::max({share_at(jerk, j, 2), share_at(jerk, j, 1), share_at(jerk, j, 0)});
    double wish = std::max({sixth_power((fast > 1 ? aim_too_fast : kAimSpeed) * fast),
                            cube((bent > 1 ? aim_beyond : aim) * bent), square(aim * jerky)});
    if (mode.finishing) {
      const double away = std::max({shares.place()[j], shares.place()[j + 1], 1.0}) - 1;
      wish = std::max(wish, sixth_power(1 + kStretchAway * away));
    }
    if (mode.finishing && wish <= 1) {  // most are, by then
      wishes_[j + 2] = 1;
      continue;
    }
    const bool at_once = mode.urgent || (mode.finishing && j + mode.spare_end >= steps);
    if (!at_once) wish = std::sqrt(wish);
    wish = std::min(std::max(wish, shortest), longest);
    if (wish > 1) wish = 1 + (wish - 1) * freedom(j, steps, mode);
    wishes_[j + 2] = cube_root(std::sqrt(wish));
  }
  wishes_[0] = wishes_[1] = wishes_[2];
  wishes_[steps + 2] = wishes_[steps + 3] = wishes_[steps + 1];
  smooth();
}

void Paces::smooth() {
  paces_.resize(wishes_.size() - 4);
  for (std::size_t i = 0; i < paces_.size(); ++i) {
    const auto* wish = &wishes_[i];
    paces_[i] = (wish[0] + 3 * wish[1] + 4 * wish[2] + 3 * wish[3] + wish[4]) * (1.0 / 12);
  }
}

void Paces::round(double least) {
  for (std::size_t from = 0, to = 0; from < paces_.size(); from = to + 1) {
    double excess = 0;
    for (to = from; to < paces_.size() && paces_[to] > 1; ++to) excess += paces_[to] - 1;
    if (excess == 0) continue;
    const double scale = std::max(0.0, std::ceil(excess - least)) / excess;
    for (std::size_t i = from; i < to; ++i) paces_[i] = 1 + scale * (paces_[i] - 1);
  }
}

double Paces::total() const { return std::accumulate(paces_.begin(), paces_.end(), 0.0); }

void Paces::find_old_times(std::size_t count, std::vector<double>& old_times) const {
  const double scale = static_cast<double>(count - 1) / total();
  old_times.resize(count);
  std::size_t i = 0;
  double begin = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double time = static_cast<double>(k);
    while (i + 1 < paces_.size() && begin + paces_[i] * scale < time) begin += paces_[i++] * scale;
    old_times[k] = static_cast<double>(i) + std::min(std::max((time - begin) / (paces_[i] * scale), 0.0), 1.0);
  }
}

}  // namespace kcs::planning
