#include "server/planning/smooth_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace kcs::planning {
namespace {

// Rounds in which time may be shortened as well, and then, at most, those in which it is only stretched.
constexpr int kSearching = 40, kFinishing = 80;
// When finishing has taken so many rounds, time is stretched faster.
constexpr int kPatience = 10;
// After so many rounds time is changed for the first time: the draft has corners in its speed.
constexpr int kSettling = 5;
// A motion this near to its limits is slowed down evenly rather than searched on.
constexpr double kNearlyKept = 1.01;
// Searching aims at this share of the limits, and of the tolerance, so that it ends inside them.
constexpr double kAimLimits = 1.02, kAimSpeed = 1.006, kAimPlace = 0.9;

// The change of a weight in one round: at least, at most.
constexpr double kPlaceEase = 0.7, kPlaceEaseFinishing = 0.95, kPlacePress = 1.6;
constexpr double kEase = 0.7, kPress = 1.4;
// Bounds of the weights. A place weight of w against a jerk weight of 1 holds a point about w^(-1/6) steps wide.
constexpr double kHeld = 1e9, kFirmest = 1e4;
// As shares of the time in which an axis reaches its acceleration: of its place at most, and for the speed's sake while
// searching, finishing, and when that has taken long.
constexpr double kWidestHold = 0.8, kSpeedHold = 0.3, kSpeedHoldFinishing = 0.2, kSpeedHoldUrgent = 0.04;
constexpr double kLeastJerk = 0.05, kMostJerk = 50;
constexpr double kLeastAcceleration = 1e-4, kMostAcceleration = 100;
// How much more firmly a point is held to its time where the tool is too fast, per excess of speed.
constexpr double kSpeedPress = 10;

// The change of a step in one round; a step that is too far away from the path is stretched by this share of the
// excess.
constexpr double kShortest = 0.95, kLongest = 1.15;
constexpr double kStretchAway = 0.3;
// Weights belong to places, and to times where the tool is slower than this, mm/s.
constexpr double kDrift = 0.5;
// While finishing, the motion gets a step longer when its steps ask for so much more.
constexpr double kLeastGrowth = 0.25;
// A motion that has become so many times as long as its draft, which is slow already, leads nowhere.
constexpr double kMostGrowth = 3;
constexpr std::size_t kFewestSteps = 7;

// The place weight that holds a point over `time`, s.
double hold_over(double time, double step) {
  const double steps = time / step, cube = steps * steps * steps;
  return 1 / (cube * cube);
}

// In which the first axis reaches its acceleration, s.
double ramp_time(const motion::AxisLimits& limits) {
  const auto axes = static_cast<Eigen::Index>(limits.axes);
  return (limits.acceleration.head(axes).array() / limits.jerk.head(axes).array()).minCoeff();
}

}  // namespace

double step_of_time(double tolerance, const motion::AxisLimits& limits) {
  constexpr double kShareOfRamp = 0.1, kShareOfCorner = 0.12;
  const double jerk = limits.jerk.head(static_cast<Eigen::Index>(limits.axes)).maxCoeff();
  return std::min(kShareOfRamp * ramp_time(limits), kShareOfCorner * std::cbrt(6 * tolerance / jerk));
}

SmoothMotion::SmoothMotion(const StretchPath& path, const motion::AxisLimits& limits, double step)
    : path_(path), limits_(limits), step_(step) {}

bool SmoothMotion::search(const MotionRange& range, MotionDraft draft) {
  if (draft.ways.empty()) return false;
  range_ = range;
  spline_.step = step_;
  spline_.ways = std::move(draft.ways);
  weights_ = std::move(draft.weights);
  speeds_ = range.at_most;
  hold_ends();
  const double longest = kMostGrowth * static_cast<double>(spline_.ways.size());
  for (int round = 0; round < kSearching + kFinishing && static_cast<double>(spline_.ways.size()) <= longest; ++round) {
    finishing_ = round >= kSearching;
    urgent_ = round >= kSearching + kPatience;
    work_ += static_cast<double>(spline_.ways.size());
    fit();
    shares_.measure(path_, limits_, spline_, legs_);
    if (finishing_ && accept()) return true;
    reweigh();
    if (round >= kSettling) retime();
  }
  return false;
}

// The first and the last three points are where and as fast as they must be.
void SmoothMotion::hold_ends() {
  auto& ways = spline_.ways;
  const std::size_t size = ways.size();
  const double in = speeds_.entry * step_, out = speeds_.exit * step_;
  for (std::size_t i = 0; i < 3; ++i) {
    const double side = static_cast<double>(i) - 1;
    ways[i] = range_.before != nullptr ? range_.before->ways.end()[static_cast<std::ptrdiff_t>(i) - 3]
                                       : range_.from + side * in;
    ways[size - 3 + i] = range_.to + side * out;
  }
  for (std::size_t i = 3; i + 3 < size; ++i)
    ways[i] = std::clamp(ways[i], ways[i - 1], std::max(ways[i - 1], ways[size - 3]));
  for (std::size_t i = 0; i < 3; ++i) weights_.place[i] = weights_.place[size - 1 - i] = kHeld;
}

void SmoothMotion::fit() {
  const std::size_t size = spline_.ways.size();
  drawn_to_ = spline_.ways;
  data_.resize(size);
  legs_.resize(size);
  std::size_t leg = path_.leg_at(drawn_to_.front());
  for (std::size_t i = 0; i < size; ++i) {
    legs_[i] = leg = path_.leg_at(drawn_to_[i], leg);
    data_[i] = path_.at(leg, drawn_to_[i]);
  }
  if (range_.before != nullptr) std::copy_n(range_.before->points.end() - 3, 3, data_.begin());
  fit_.solve(weights_, data_, spline_.points);
  for (std::size_t i = 0; i < 3; ++i) {
    spline_.points[i] = data_[i];
    spline_.points[size - 1 - i] = data_[size - 1 - i];
  }
}

bool SmoothMotion::accept() {
  if (shares_.largest_place() > 1) return false;
  // What goes on from another motion must keep its step.
  const double allowed = range_.before != nullptr ? 1 - motion::kRoundingShare : kNearlyKept;
  if (shares_.slower() > allowed || !shares_.verify_places(path_, limits_, spline_)) return false;
  slow_down_evenly();
  return true;
}

// The curve stays.
void SmoothMotion::slow_down_evenly() {
  const double slower = shares_.slower() * (1 + motion::kRoundingShare);
  if (slower <= 1) return;
  spline_.step *= slower;
  speeds_.entry /= slower;
  speeds_.exit /= slower;
}

void SmoothMotion::reweigh() {
  const std::size_t size = spline_.points.size();
  const double ramp = ramp_time(limits_);
  const double widest = hold_over(kWidestHold * ramp, step_);
  const double speed_hold = hold_over((urgent_      ? kSpeedHoldUrgent
                                       : finishing_ ? kSpeedHoldFinishing
                                                    : kSpeedHold) *
                                          ramp,
                                      step_);
  const auto& speed = shares_.speed();
  for (std::size_t i = 1; i + 1 < size; ++i) {
    double& weight = weights_.place[i];
    const double fast = kAimSpeed * std::max(speed[i - 1], speed[i]);
    double pressure = shares_.place()[i] / kAimPlace;
    if (fast > 1 && weight < speed_hold) pressure = std::max(pressure, 1 + kSpeedPress * (fast - 1));
    const double ease = finishing_ ? kPlaceEaseFinishing : kPlaceEase;
    weight = std::clamp(weight * std::clamp(pressure, ease, kPlacePress), widest, kFirmest);
  }
  for (std::size_t j = 0; j + 3 < size; ++j) {
    double& weight = weights_.jerk[j];
    weight *= std::clamp(std::sqrt(kAimLimits * shares_.jerk()[j]), kEase, kPress);
    weight = std::clamp(weight, kLeastJerk, kMostJerk);
  }
  for (std::size_t j = 0; j + 2 < size; ++j) {
    double& weight = weights_.acceleration[j];
    weight *= std::clamp(kAimLimits * shares_.acceleration()[j], kEase, kPress);
    weight = std::clamp(weight, kLeastAcceleration, kMostAcceleration);
  }
}

void SmoothMotion::retime() {
  set_paces();
  const std::size_t steps = paces_.size();
  double total = 0;
  for (const double pace : paces_) total += pace;
  const double whole = finishing_ ? std::ceil(total - kLeastGrowth) : std::floor(total + 0.5);
  const std::size_t wanted = std::max(kFewestSteps, static_cast<std::size_t>(whole));
  std::swap(old_ways_, spline_.ways);
  std::swap(old_weights_, weights_);
  resample_ways(wanted + 1, static_cast<double>(wanted) / total);
  resample_weights();
  speeds_.entry = std::min(range_.at_most.entry, speeds_.entry * 4 / (paces_[0] + paces_[1] + paces_[2] + paces_[3]));
  speeds_.exit =
      std::min(range_.at_most.exit,
               speeds_.exit * 4 / (paces_[steps - 1] + paces_[steps - 2] + paces_[steps - 3] + paces_[steps - 4]));
  hold_ends();
}

// Every step longer or shorter as what it is part of asks for, smoothed over its neighbours.
void SmoothMotion::set_paces() {
  const std::size_t steps = spline_.ways.size() - 1;
  wishes_.assign(steps, 0);
  const auto wish = [&](std::size_t from, std::size_t count, double value) {
    for (std::size_t i = from; i < from + count; ++i) wishes_[i] = std::max(wishes_[i], value);
  };
  for (std::size_t j = 0; j < steps; ++j) wish(j, 1, kAimSpeed * shares_.speed()[j]);
  for (std::size_t j = 0; j + 1 < steps; ++j) wish(j, 2, std::sqrt(kAimLimits * shares_.acceleration()[j]));
  for (std::size_t j = 0; j + 2 < steps; ++j) wish(j, 3, std::cbrt(kAimLimits * shares_.jerk()[j]));
  if (finishing_) {
    for (std::size_t i = 1; i < steps; ++i) {
      if (shares_.place()[i] > 1) wish(i - 1, 2, 1 + kStretchAway * (shares_.place()[i] - 1));
    }
  }
  for (double& value : wishes_)
    value = std::clamp(urgent_ ? value : std::sqrt(value), finishing_ ? 1 : kShortest, kLongest);
  paces_.resize(steps);
  const auto at = [&](std::ptrdiff_t i) {
    return wishes_[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, static_cast<std::ptrdiff_t>(steps) - 1))];
  };
  for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(steps); ++i) {
    paces_[static_cast<std::size_t>(i)] = (at(i - 2) + 3 * at(i - 1) + 4 * at(i) + 3 * at(i + 1) + at(i + 2)) / 12;
  }
}

// The ways at equal times again. Step i took its pace times `scale`.
void SmoothMotion::resample_ways(std::size_t count, double scale) {
  spline_.ways.resize(count);
  old_times_.resize(count);
  std::size_t i = 0;
  double begin = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double time = static_cast<double>(k);
    while (i + 1 < paces_.size() && begin + paces_[i] * scale < time) begin += paces_[i++] * scale;
    const double share = std::clamp((time - begin) / (paces_[i] * scale), 0.0, 1.0);
    spline_.ways[k] = old_ways_[i] + share * (old_ways_[i + 1] - old_ways_[i]);
    old_times_[k] = static_cast<double>(i) + share;
  }
}

// Each point gets the weights that were used at its place.
void SmoothMotion::resample_weights() {
  const std::size_t size = old_ways_.size(), count = spline_.ways.size();
  for (std::size_t i = 0; i < 3; ++i) {  // those of the ends say nothing
    old_weights_.place[i] = old_weights_.place[3];
    old_weights_.place[size - 1 - i] = old_weights_.place[size - 4];
  }
  weights_.place.resize(count);
  weights_.acceleration.resize(count);
  weights_.jerk.resize(count);
  const double drift = kDrift * step_;
  const auto old = [&](std::size_t i) { return drawn_to_[i] + drift * static_cast<double>(i); };
  std::size_t i = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double place = spline_.ways[k] + drift * old_times_[k];
    while (i + 2 < size && old(i + 1) < place) ++i;
    const double share = std::clamp((place - old(i)) / (old(i + 1) - old(i)), 0.0, 1.0);
    const auto between = [&](const std::vector<double>& values) {
      return values[i] + share * (values[i + 1] - values[i]);
    };
    weights_.place[k] = between(old_weights_.place);
    weights_.acceleration[k] = between(old_weights_.acceleration);
    weights_.jerk[k] = between(old_weights_.jerk);
  }
}

}  // namespace kcs::planning
