#include "server/planning/smooth_motion.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "server/planning/density.h"
#include "server/planning/reweighing.h"

namespace kcs::planning {
namespace {

// Rounds, at most: in which time may be shortened as well, the first of them with longer steps, and then those in which
// it is only stretched.
constexpr int kSearchingCoarsely = 20, kSearching = 28, kFinishing = 80;
constexpr double kCoarser = 2;
// Searching that has changed the duration by no more than this share in so many rounds, one after the other, goes on
// with the shorter steps or, if it did, with finishing.
constexpr double kSteady = 1.5e-3, kSteadyBrisk = 2.5e-3;
constexpr int kSteadyRounds = 3;
// In so many rounds the motion is too far from its end to look at it closely.
constexpr int kRough = 9;
// Motions of fewer points are searched with their own steps only.
constexpr std::size_t kFewestToCoarsen = 40;
// When finishing has taken so many rounds, time is stretched faster.
constexpr int kPatience = 5;
// After so many rounds time is changed for the first time: the draft has corners in its speed, and other steps cut
// corners in another way.
constexpr int kSettling = 3, kSettlingAgain = 2;
// A motion this near to its limits is slowed down evenly rather than searched on.
constexpr double kNearlyKept = 1.01, kNearlyKeptWithFullEffort = 1.001;
// When finishing has taken so many rounds, what the machine waits for may be slowed down by more, by this much for each
// of so many rounds.
constexpr int kFirmRounds = 8, kEasingRounds = 8;
constexpr double kEasing = 0.005;
// The place weight of the first and the last three points.
constexpr double kHeld = 1e9;
// Weights belong to places, and to times where the tool is slower than this, mm/s.
constexpr double kDrift = 0.5;
// While finishing, the motion gets a step longer when its steps have asked for 1 − kEager of one.
constexpr double kEager = 0.75;
// What is at this share of the feed moves; what is at this share of such a speed stands.
constexpr double kMoves = 0.1, kStands = 0.1;
// A motion that has become so many times as long as its draft, which is slow already, leads nowhere.
constexpr double kMostGrowth = 3;
constexpr std::size_t kFewestSteps = 7;
// Steps at an end whose mean pace becomes that of the end, at least.
constexpr std::size_t kFewestNear = 4;

// Where corners are crowded, finishing puts in whole steps of time: where this much of one is asked for, at first, and
// so many rounds later.
constexpr double kLeastStep = 0.5, kLeastStepLate = 0.02, kLate = 60;

double square(double value) { return value * value; }
double cube(double value) { return value * value * value; }

// std::clamp without branches: for weights they could not be foreseen.
double bounded(double value, double least, double most) { return std::min(std::max(value, least), most); }

// In which the first axis reaches its acceleration, s.
double ramp_time(const motion::AxisLimits& limits) {
  const auto axes = static_cast<Eigen::Index>(limits.axes);
  return (limits.acceleration.head(axes).array() / limits.jerk.head(axes).array()).minCoeff();
}

// What takes less time is a matter of jerk and tolerance or, where jerk hardly matters, of acceleration and tolerance,
// s.
double hold_time(double tolerance, const motion::AxisLimits& limits) {
  constexpr double kBends = 4;
  const double acceleration = limits.acceleration.head(static_cast<Eigen::Index>(limits.axes)).maxCoeff();
  return std::max(ramp_time(limits), kBends * std::sqrt(tolerance / acceleration));
}

double step_of_time(double share_of_corner, double tolerance, const motion::AxisLimits& limits) {
  constexpr double kShareOfRamp = 0.25;
  const auto axes = static_cast<Eigen::Index>(limits.axes);
  const double of_jerk = share_of_corner * std::cbrt(6 * tolerance / limits.jerk.head(axes).maxCoeff());
  const double of_acceleration = share_of_corner * std::sqrt(tolerance / limits.acceleration.head(axes).maxCoeff());
  return std::min(of_jerk, std::max(kShareOfRamp * ramp_time(limits), of_acceleration));
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
  constexpr double kShareOfCorner = 0.12;
  return step_of_time(kShareOfCorner, tolerance, limits);
}

double long_step_of_time(double tolerance, const motion::AxisLimits& limits) {
  constexpr double kShareOfCorner = 0.2;
  return step_of_time(kShareOfCorner, tolerance, limits);
}

SmoothMotion::SmoothMotion(const StretchPath& path, const motion::AxisLimits& limits, double step,
                           const std::stop_token& stop)
    : path_(path), limits_(limits), step_(step), stop_(stop), hold_time_(hold_time(path.tolerance(), limits)) {}

bool SmoothMotion::search(const MotionRange& range, MotionDraft draft) {
  // A draft may be of longer steps: those of what was found before a leg whose tolerance is far less.
  if (draft.ways.empty() || static_cast<double>(draft.ways.size()) * draft.step > kMostPoints * step_) return false;
  range_ = range;
  missing_ = 0;
  spline_.step = draft.step;
  spline_.ways = draft.ways;
  weights_ = std::move(draft.weights);
  // From the draft's speeds the motion becomes faster; from too fast ones it would hardly find back.
  const auto& ways = spline_.ways;
  speeds_ = {(ways[1] - ways[0]) / draft.step, (ways.end()[-1] - ways.end()[-2]) / draft.step};
  if (range_.exact) speeds_ = range_.at_most;
  const double steps = static_cast<double>(ways.size()) * draft.step / step_;
  mode_.crowded = is_crowded(path_, range_.from, range_.to, static_cast<std::size_t>(steps));
  mode_.brisk = range_.dense && range_.effort != Effort::kFull;
  mode_.spare_end = mode_.brisk ? kStepsAhead : 0;
  if (!mode_.crowded) {
    for (Vector& jerk : weights_.jerk) jerk.setConstant(jerk.maxCoeff());
  }
  shares_.begin(path_, range_.settled, stop_);
  change_step(spline_.ways.size() < kFewestToCoarsen ? step_ : kCoarser * step_);
  const double longest = kMostGrowth * spline_.step * static_cast<double>(spline_.ways.size());
  int settled = kSettling, steady = 0;
  for (int round = 0; round < kSearching + kFinishing; ++round) {
    if (round == kSearchingCoarsely && spline_.step > step_) {
      change_step(step_);
      settled = round + kSettlingAgain;
    }
    const auto size = static_cast<double>(spline_.ways.size());
    if (spline_.step * size > longest) break;
    mode_.finishing = round >= kSearching;
    find_held_steps();
    mode_.urgent = round >= kSearching + kPatience;
    const double late = std::clamp((round - kSearching) / kLate, 0.0, 1.0);
    eased_ = kEasing * std::clamp(round - kSearching - kFirmRounds, 0, kEasingRounds);
    least_step_ = kLeastStep + late * (kLeastStepLate - kLeastStep);
    fit();
    shares_.measure(path_, limits_, spline_, legs_, mode_.finishing || (spline_.step > step_ && round >= kRough));
    if (mode_.finishing && accept()) return !stands(draft.ways, draft.step);
    reweigh(shares_, mode_, hold_time_ / spline_.step, weights_);
    if (round < settled) continue;
    steady = retime() < (mode_.brisk ? kSteadyBrisk : kSteady) ? steady + 1 : 0;
    if (steady < kSteadyRounds || mode_.finishing) continue;
    round = (round < kSearchingCoarsely ? kSearchingCoarsely : kSearching) - 1;
    steady = 0;
  }
  return false;
}

void SmoothMotion::find_held_steps() {
  const double steps = hold_time_ / spline_.step;
  const bool starts_in_motion = range_.exact && range_.at_most.entry > 0;
  mode_.held_start = range_.before != nullptr || starts_in_motion ? steps : 0;
  mode_.held_end = range_.exact && range_.at_most.exit > 0 ? steps : 0;
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
    weights_.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
      const double at = std::clamp(1 + (static_cast<double>(k) - 1) / finer, 0.0, static_cast<double>(size - 1));
      const std::size_t i = std::min(static_cast<std::size_t>(at), size - 2);
      const double share = at - static_cast<double>(i);
      spline_.ways[k] = between(old_ways_, i, share);
      // Second differences change with the square of the step, third ones with its cube; the weights with their
      // squares.
      weights_.set_between(k, old_weights_, i, share);
      weights_.place[k] = std::min(weights_.place[k] / square(cube(finer)), kFirmest);
      weights_.acceleration[k] /= square(finer);
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
  if (spline_.step == range_.before->step) return;
  const double longer = spline_.step / range_.before->step;
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
  // The motion ends along the last leg, even if that is shorter than a step.
  for (std::size_t i = size - 3; i < size; ++i) data_[i] = path_.at(path_.legs().size() - 1, drawn_to_[i]);
  fit_.solve(weights_, !mode_.crowded, data_, spline_.points);
  for (std::size_t i = 0; i < 3; ++i) {
    spline_.points[i] = data_[i];
    spline_.points[size - 1 - i] = data_[size - 1 - i];
  }
}

bool SmoothMotion::accept() {
  if (shares_.largest_place() > 1) return false;
  if (shares_.slower() > allowed() || !shares_.verify_places(path_, limits_, spline_)) return false;
  slow_down_evenly();
  return true;
}

// What goes on from another motion must keep its step, and what ends at certain speeds too.
double SmoothMotion::allowed() const {
  if (range_.before != nullptr || range_.exact) return 1 - motion::kRoundingShare;
  if (range_.effort == Effort::kFull) return kNearlyKeptWithFullEffort;
  return kNearlyKept + (range_.effort == Effort::kLeast ? eased_ : 0);
}

// Whether the motion keeps all limits because it hardly moves where the draft does: a search can end like that where it
// goes on from another motion.
bool SmoothMotion::stands(const std::vector<double>& draft, double step) const {
  const auto& ways = spline_.ways;
  std::size_t k = 1;
  for (std::size_t i = 1; i + 1 < draft.size(); ++i) {
    const double speed = (draft[i + 1] - draft[i - 1]) / (2 * step), feed = path_.feed_between(draft[i], draft[i]);
    if (speed < kMoves * feed) continue;
    while (k + 2 < ways.size() && ways[k + 1] < draft[i]) ++k;
    if (ways[k + 1] - ways[k] < kStands * speed * spline_.step) return true;
  }
  return false;
}

// The curve stays.
void SmoothMotion::slow_down_evenly() {
  const double slower = shares_.slower() * (1 + motion::kRoundingShare);
  if (slower <= 1) return;
  spline_.step *= slower;
  speeds_.entry /= slower;
  speeds_.exit /= slower;
}

// Returns the change of the duration, as a share of it.
double SmoothMotion::retime() {
  const bool whole_steps = mode_.crowded && mode_.finishing;
  paces_.set(shares_, mode_);
  if (whole_steps) paces_.round(least_step_);
  const double total = paces_.total();
  double whole = std::floor(total + 0.5);
  if (mode_.finishing && !whole_steps) {  // what a round does not give is not forgotten
    whole = std::floor(total + missing_ + kEager);
    missing_ += total - whole;
  }
  resample(std::max(kFewestSteps, static_cast<std::size_t>(whole)) + 1);
  slow_ends_down();
  hold_ends();
  return std::abs(total / static_cast<double>(paces_.values().size()) - 1);
}

// The ends become as much slower as what follows them, for no corner may leave the tool the way to brake; while
// finishing, only as what is next to them, for there they become no faster again.
void SmoothMotion::slow_ends_down() {
  if (range_.exact) return;
  const auto& paces = paces_.values();
  const double hold = mode_.finishing ? 0 : hold_time_ / spline_.step;
  const std::size_t near = std::clamp(static_cast<std::size_t>(hold), kFewestNear, paces.size());
  const auto mean = [&](auto first) {
    return std::accumulate(first, first + static_cast<std::ptrdiff_t>(near), 0.0) / static_cast<double>(near);
  };
  speeds_.entry = std::min(range_.at_most.entry, speeds_.entry / mean(paces.begin()));
  speeds_.exit = std::min(range_.at_most.exit, speeds_.exit / mean(paces.rbegin()));
}

// The ways at equal times again, and each point with the weights that were used at its place.
void SmoothMotion::resample(std::size_t count) {
  std::swap(old_ways_, spline_.ways);
  std::swap(old_weights_, weights_);
  forget_ends(old_weights_);
  const std::size_t size = old_ways_.size();
  paces_.find_old_times(count, old_times_);
  spline_.ways.resize(count);
  weights_.resize(count);
  const double drift = kDrift * spline_.step;
  const auto old = [&](std::size_t i) { return drawn_to_[i] + drift * static_cast<double>(i); };
  std::size_t i = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t step = std::min(static_cast<std::size_t>(old_times_[k]), size - 2);
    spline_.ways[k] = between(old_ways_, step, old_times_[k] - static_cast<double>(step));
    const double place = spline_.ways[k] + drift * old_times_[k];
    while (i + 2 < size && old(i + 1) < place) ++i;
    weights_.set_between(k, old_weights_, i, bounded((place - old(i)) / (old(i + 1) - old(i)), 0, 1));
  }
}

}  // namespace kcs::planning
