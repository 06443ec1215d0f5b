#include "server/planning/smooth_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace kcs::planning {
namespace {

// Rounds in which time may be shortened as well, the first of them with longer steps, and then, at most, those in which
// it is only stretched.
constexpr int kSearchingCoarsely = 18, kSearching = 26, kFinishing = 80;
constexpr double kCoarser = 2;
// Motions of fewer points are searched with their own steps only.
constexpr std::size_t kFewestToCoarsen = 40;
// When finishing has taken so many rounds, time is stretched faster.
constexpr int kPatience = 5;
// After so many rounds time is changed for the first time: the draft has corners in its speed, and other steps cut
// corners in another way.
constexpr int kSettling = 3, kSettlingAgain = 2;
// A motion this near to its limits is slowed down evenly rather than searched on.
constexpr double kNearlyKept = 1.01;
// Searching aims at this share of the limits, and of the tolerance, so that it ends inside them.
constexpr double kAimLimits = 1.02, kAimPlace = 0.9;

// The change of a weight in one round: at least, at most. While finishing, weights ease little: what is settled should
// not come up again.
constexpr double kPlaceEase = 0.5, kPlaceEaseFinishing = 0.95, kPlacePress = 1.6;
constexpr double kEase = 0.7, kEaseFinishing = 0.96, kPress = 1.4;
// Bounds of the weights. A place weight of w against a jerk weight of 1 holds a point about w^(-1/6) steps wide.
constexpr double kHeld = 1e9, kFirmest = 1e4;
// As shares of the time in which an axis reaches its acceleration: of its place at most, and for the speed's sake while
// searching, finishing, and when that has taken long.
constexpr double kWidestHold = 0.8, kSpeedHold = 0.3, kSpeedHoldFinishing = 0.2, kSpeedHoldUrgent = 0.04;
constexpr double kLeastJerk = 0.05, kMostJerk = 50;
constexpr double kLeastAcceleration = 1e-4, kMostAcceleration = 100;
// How much more firmly a point is held to its time where the tool is too fast, per excess of speed.
constexpr double kSpeedPress = 10;

// Weights belong to places, and to times where the tool is slower than this, mm/s.
constexpr double kDrift = 0.5;
// While finishing, the motion gets a step longer when its steps have asked for 1 − kEager of one.
constexpr double kEager = 0.75;
// A motion that has become so many times as long as its draft, which is slow already, leads nowhere.
constexpr double kMostGrowth = 3;
constexpr std::size_t kFewestSteps = 7;

double square(double value) { return value * value; }
double cube(double value) { return value * value * value; }

// std::clamp without branches: in the weights they could not be foreseen.
double bounded(double value, double least, double most) { return std::min(std::max(value, least), most); }

// The place weight that holds a point over `time`, s.
double hold_over(double time, double step) { return 1 / square(cube(time / step)); }

// In which the first axis reaches its acceleration, s.
double ramp_time(const motion::AxisLimits& limits) {
  const auto axes = static_cast<Eigen::Index>(limits.axes);
  return (limits.acceleration.head(axes).array() / limits.jerk.head(axes).array()).minCoeff();
}

void resize(FitWeights& weights, std::size_t size) {
  weights.place.resize(size);
  weights.acceleration.resize(size);
  weights.jerk.resize(size);
}

// The place weights of the ends say nothing.
void forget_ends(FitWeights& weights) {
  const std::size_t size = weights.place.size();
  for (std::size_t i = 0; i < 3; ++i) {
    weights.place[i] = weights.place[3];
    weights.place[size - 1 - i] = weights.place[size - 4];
  }
}

double between(const std::vector<double>& values, std::size_t i, double share) {
  return values[i] + share * (values[i + 1] - values[i]);
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
  speeds_ = range.at_most;
  missing_ = 0;
  spline_.step = step_;
  spline_.ways = std::move(draft.ways);
  weights_ = std::move(draft.weights);
  change_step(spline_.ways.size() < kFewestToCoarsen ? step_ : kCoarser * step_);
  const double longest = kMostGrowth * spline_.step * static_cast<double>(spline_.ways.size());
  int settled = kSettling;
  for (int round = 0; round < kSearching + kFinishing; ++round) {
    if (round == kSearchingCoarsely && spline_.step > step_) {
      change_step(step_);
      settled = round + kSettlingAgain;
    }
    const auto size = static_cast<double>(spline_.ways.size());
    if (spline_.step * size > longest) break;
    work_ += size;
    finishing_ = round >= kSearching;
    urgent_ = round >= kSearching + kPatience;
    fit();
    shares_.measure(path_, limits_, spline_, legs_, finishing_ || spline_.step > step_);
    if (finishing_ && accept()) return true;
    reweigh();
    if (round >= settled) retime();
  }
  return false;
}

// The same motion by points at other times.
void SmoothMotion::change_step(double step) {
  const double finer = spline_.step / step;
  if (finer != 1) {
    const std::size_t size = spline_.ways.size();
    const auto steps = static_cast<std::size_t>(std::ceil(static_cast<double>(size - 3) * finer));
    const std::size_t count = std::max(kFewestSteps, steps + 2) + 1;
    std::swap(old_ways_, spline_.ways);
    std::swap(old_weights_, weights_);
    forget_ends(old_weights_);
    spline_.ways.resize(count);
    resize(weights_, count);
    for (std::size_t k = 0; k < count; ++k) {
      const double at = std::clamp(1 + (static_cast<double>(k) - 1) / finer, 0.0, static_cast<double>(size - 1));
      const std::size_t i = std::min(static_cast<std::size_t>(at), size - 2);
      const double share = at - static_cast<double>(i);
      spline_.ways[k] = between(old_ways_, i, share);
      // Second differences change with the square of the step, third ones with its cube; the weights with their
      // squares.
      weights_.place[k] = std::min(between(old_weights_.place, i, share) / square(cube(finer)), kFirmest);
      weights_.acceleration[k] = between(old_weights_.acceleration, i, share) / square(finer);
      weights_.jerk[k] = between(old_weights_.jerk, i, share);
    }
    spline_.step = step;
  }
  find_start();
  hold_ends();
}

// The first three points, so that the motion goes on from the one before it with its speed and acceleration, in steps
// of any length.
void SmoothMotion::find_start() {
  if (range_.before == nullptr) return;
  const auto points = range_.before->points.end() - 3;
  const auto ways = range_.before->ways.end() - 3;
  std::copy_n(points, 3, start_points_.begin());
  std::copy_n(ways, 3, start_ways_.begin());
  if (spline_.step == step_) return;
  const double longer = spline_.step / step_;
  const Vector bend = points[2] - 2 * points[1] + points[0], move = longer * (points[2] - points[0]) / 2;
  start_points_[1] += (1 - square(longer)) / 6 * bend;
  start_points_[0] = start_points_[1] - move + square(longer) / 2 * bend;
  start_points_[2] = start_points_[1] + move + square(longer) / 2 * bend;
  start_ways_[0] = ways[1] - longer * (ways[1] - ways[0]);
  start_ways_[2] = ways[1] + longer * (ways[2] - ways[1]);
}

// The first and the last three points are where and as fast as they must be.
void SmoothMotion::hold_ends() {
  auto& ways = spline_.ways;
  const std::size_t size = ways.size();
  const double in = speeds_.entry * spline_.step, out = speeds_.exit * spline_.step;
  for (std::size_t i = 0; i < 3; ++i) {
    const double side = static_cast<double>(i) - 1;
    ways[i] = range_.before != nullptr ? start_ways_[i] : range_.from + side * in;
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
  if (range_.before != nullptr) std::copy_n(start_points_.begin(), 3, data_.begin());
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
  const double widest = hold_over(kWidestHold * ramp, spline_.step);
  const double speed_hold = hold_over((urgent_      ? kSpeedHoldUrgent
                                       : finishing_ ? kSpeedHoldFinishing
                                                    : kSpeedHold) *
                                          ramp,
                                      spline_.step);
  const double place_ease = finishing_ ? kPlaceEaseFinishing : kPlaceEase, ease = finishing_ ? kEaseFinishing : kEase;
  const auto& speed = shares_.speed();
  for (std::size_t i = 1; i + 1 < size; ++i) {
    double& weight = weights_.place[i];
    const double fast = kAimSpeed * std::max(speed[i - 1], speed[i]);
    const double too_fast = fast > 1 && weight < speed_hold ? 1 + kSpeedPress * (fast - 1) : 0;
    const double pressure = std::max(shares_.place()[i] * (1 / kAimPlace), too_fast);
    weight = bounded(weight * bounded(pressure, place_ease, kPlacePress), widest, kFirmest);
  }
  for (std::size_t j = 0; j + 3 < size; ++j) {
    const double share = kAimLimits * shares_.jerk()[j];
    const double pressure = finishing_ ? share : std::sqrt(share);
    weights_.jerk[j] = bounded(weights_.jerk[j] * bounded(pressure, ease, kPress), kLeastJerk, kMostJerk);
  }
  for (std::size_t j = 0; j + 2 < size; ++j) {
    const double share = kAimLimits * shares_.acceleration()[j];
    const double pressure = finishing_ ? square(share) : cube(share);
    double& weight = weights_.acceleration[j];
    weight = bounded(weight * bounded(pressure, ease, kPress), kLeastAcceleration, kMostAcceleration);
  }
}

void SmoothMotion::retime() {
  const auto& paces = shares_.paces(finishing_, urgent_);
  const std::size_t steps = paces.size();
  double total = 0;
  for (const double pace : paces) total += pace;
  double whole = std::floor(total + 0.5);
  if (finishing_) {  // what a round does not give is not forgotten
    whole = std::floor(total + missing_ + kEager);
    missing_ += total - whole;
  }
  const std::size_t wanted = std::max(kFewestSteps, static_cast<std::size_t>(whole));
  std::swap(old_ways_, spline_.ways);
  std::swap(old_weights_, weights_);
  resample_ways(paces, wanted + 1, static_cast<double>(wanted) / total);
  resample_weights();
  speeds_.entry = std::min(range_.at_most.entry, speeds_.entry * 4 / (paces[0] + paces[1] + paces[2] + paces[3]));
  speeds_.exit =
      std::min(range_.at_most.exit,
               speeds_.exit * 4 / (paces[steps - 1] + paces[steps - 2] + paces[steps - 3] + paces[steps - 4]));
  hold_ends();
}

// The ways at equal times again. Step i took its pace times `scale`.
void SmoothMotion::resample_ways(const std::vector<double>& paces, std::size_t count, double scale) {
  spline_.ways.resize(count);
  old_times_.resize(count);
  std::size_t i = 0;
  double begin = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double time = static_cast<double>(k);
    while (i + 1 < paces.size() && begin + paces[i] * scale < time) begin += paces[i++] * scale;
    const double share = bounded((time - begin) / (paces[i] * scale), 0, 1);
    spline_.ways[k] = between(old_ways_, i, share);
    old_times_[k] = static_cast<double>(i) + share;
  }
}

// Each point gets the weights that were used at its place.
void SmoothMotion::resample_weights() {
  const std::size_t size = old_ways_.size(), count = spline_.ways.size();
  forget_ends(old_weights_);
  resize(weights_, count);
  const double drift = kDrift * spline_.step;
  const auto old = [&](std::size_t i) { return drawn_to_[i] + drift * static_cast<double>(i); };
  std::size_t i = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double place = spline_.ways[k] + drift * old_times_[k];
    while (i + 2 < size && old(i + 1) < place) ++i;
    const double share = bounded((place - old(i)) / (old(i + 1) - old(i)), 0, 1);
    weights_.place[k] = between(old_weights_.place, i, share);
    weights_.acceleration[k] = between(old_weights_.acceleration, i, share);
    weights_.jerk[k] = between(old_weights_.jerk, i, share);
  }
}

}  // namespace kcs::planning
