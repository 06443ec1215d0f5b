#include "server/planning/reweighing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace kcs::planning {
namespace {

// Searching aims at this share of the tolerance (and at kAimLimits), so that it ends inside it. Where corners are
// crowded, all of it counts.
constexpr double kAimPlace = 0.9, kAimPlaceCrowded = 0.97;

// The change of a weight in one round: at least, at most. While finishing, weights ease little: what is settled should
// not come up again.
constexpr double kPlaceEase = 0.5, kPlaceEaseFinishing = 0.95, kPlacePress = 1.6;
constexpr double kEase = 0.7, kEaseFinishing = 0.96, kPress = 1.4, kPressBrisk = 1.7;

// As shares of the hold time: how wide a point is held for its place at most, and for the speed's sake while searching,
// finishing, and when that has taken long.
constexpr double kWidestHold = 0.8, kSpeedHold = 0.3, kSpeedHoldFinishing = 0.2, kSpeedHoldUrgent = 0.04;
// Where corners are crowded, the fastest motion has every axis at its limit of jerk nearly all the time: each axis gets
// weights of its own. Elsewhere that costs rounds and gains nothing.
constexpr double kLeastJerk = 0.05, kLeastJerkCrowded = 0.1, kMostJerk = 50;
constexpr double kLeastAcceleration = 1e-4, kMostAcceleration = 100;
// How much more firmly a point is held to its time where the tool is too fast, per excess of speed.
constexpr double kSpeedPress = 10;

double square(double value) { return value * value; }
double cube(double value) { return value * value * value; }

// std::clamp without branches: in the weights they could not be foreseen.
double bounded(double value, double least, double most) { return std::min(std::max(value, least), most); }

// The place weight that holds a point over so many steps.
double hold_over(double steps) { return 1 / square(cube(steps)); }

double speed_hold(const SearchMode& mode) {
  if (mode.urgent) return kSpeedHoldUrgent;
  return mode.finishing ? kSpeedHoldFinishing : kSpeedHold;
}

}  // namespace

void reweigh(const MotionShares& shares, const SearchMode& mode, double hold_steps, FitWeights& weights) {
  const std::size_t size = weights.place.size();
  const double widest = hold_over(kWidestHold * hold_steps), for_speed = hold_over(speed_hold(mode) * hold_steps);
  const double place_ease = mode.finishing ? kPlaceEaseFinishing : kPlaceEase;
  const double ease = mode.finishing ? kEaseFinishing : kEase, press = mode.brisk ? kPressBrisk : kPress;
  const double per_aim = 1 / (mode.crowded ? kAimPlaceCrowded : kAimPlace);
  const double least_jerk = mode.crowded ? kLeastJerkCrowded : kLeastJerk;
  const auto& haste = shares.haste();
  for (std::size_t i = 1; i + 1 < size; ++i) {
    double& weight = weights.place[i];
    const double fast = kAimSpeed * std::max(haste[i - 1], haste[i]);
    const double too_fast = fast > 1 && weight < for_speed ? 1 + kSpeedPress * (fast - 1) : 0;
    const double share = shares.place()[i] * per_aim;
    const double pressure = std::max(shares.place()[i] > 1 ? square(share) : share, too_fast);
    weight = bounded(weight * bounded(pressure, place_ease, kPlacePress), widest, kFirmest);
  }
  for (std::size_t j = 0; j + 3 < size; ++j) {
    const double share = kAimLimits * shares.jerk()[j];
    Eigen::Array3d pressure = kAimLimits * shares.axis_jerk()[j].array();
    if (!mode.crowded) pressure = mode.finishing ? share : std::sqrt(share);
    weights.jerk[j] = (weights.jerk[j].array() * pressure.max(ease).min(press)).max(least_jerk).min(kMostJerk);
  }
  for (std::size_t j = 0; j + 2 < size; ++j) {
    const double share = kAimLimits * shares.acceleration()[j];
    const bool settled = mode.finishing && share < kAimLimits;
    const double pressure = settled ? square(share) : square(cube(share));
    double& weight = weights.acceleration[j];
    weight = bounded(weight * bounded(pressure, ease, press), kLeastAcceleration, kMostAcceleration);
  }
}

}  // namespace kcs::planning
