#include "server/planning/quickest_fit.h"

#include <algorithm>
#include <cmath>

#include "server/planning/stopped.h"

namespace kcs::planning {
namespace {

constexpr std::size_t kHeldPoints = 3;  // at either end, not free
constexpr int kMostSteps = 50;
// At first: the least slack, and all slacks times their multipliers if nothing is outside. Else it is more, so that
// what is outside comes in before the gap is closed.
constexpr double kLeastSlack = 0.03, kFirstGap = 1;
// In the end: slacks times multipliers, which is how much less `longer` could be, and what is outside.
constexpr double kGap = 5e-3, kOutside = 1e-3;
// A step takes slacks and multipliers no nearer to zero than by this share.
constexpr double kNearest = 0.99;

// What holds a point in a direction in which nothing else does, as across a plane that a machine of two axes cannot
// leave. Far less than what does.
constexpr double kHold = 1e-9;

template <class Side>
typename Side::Numbers stiffness(const Side& side) {
  return side.multiplier / side.slack;
}
template <class Side>
typename Side::Numbers force(const Side& side) {
  return (side.target + side.multiplier * (side.excess + side.slack)) / side.slack;
}

// The share of a change, up to all of it, that leaves positive values positive.
template <class Numbers>
double longest(const Numbers& values, const Numbers& change) {
  return kNearest / std::max(kNearest, (-change / values).maxCoeff());
}

double cube(double value) { return value * value * value; }

}  // namespace

void QuickestFit::begin(std::span<const Vector> points) {
  points_.assign(points.begin(), points.end());
  for (const std::size_t end : {std::size_t{0}, points.size() - kHeldPoints}) {
    const Vector bend = points[end + 2] - 2 * points[end + 1] + points[end], move = (points[end + 2] - points[end]) / 2;
    Vector* drift = &drift_[end == 0 ? 0 : kHeldPoints];
    drift[0] = 2.0 / 3 * bend - move;
    drift[1] = -1.0 / 3 * bend;
    drift[2] = 2.0 / 3 * bend + move;
  }
  longer_ = 1;
  boxes_.clear();
  rounds_.clear();
}

bool QuickestFit::is_free(const PointSum& sum) const {
  return sum.first + sum.count > kHeldPoints && sum.first + kHeldPoints < points_.size();
}

bool QuickestFit::is_all_free(const PointSum& sum) const {
  return sum.first >= kHeldPoints && sum.first + sum.count + kHeldPoints <= points_.size();
}

Vector QuickestFit::drift_of(const PointSum& sum) const {
  Vector drift = Vector::Zero();
  const std::size_t end_free = points_.size() - kHeldPoints;
  for (std::size_t i = 0; i < sum.count; ++i) {
    const std::size_t point = sum.first + i;
    if (point < kHeldPoints) drift += sum.weights[i] * drift_[point];
    if (point >= end_free) drift += sum.weights[i] * drift_[kHeldPoints + point - end_free];
  }
  return drift;
}

void QuickestFit::limit_axes(const PointSum& sum, const Vector& limit, Kind kind) {
  if (!is_free(sum)) return;
  const Eigen::Array3d per_limit = limit.array().inverse(), drift = drift_of(sum).array() * per_limit;
  const auto growth = static_cast<double>(kind);
  boxes_.push_back({sum, per_limit, growth - drift, growth + drift});
}

void QuickestFit::limit_speed(const PointSum& sum, double limit) {
  if (is_free(sum)) rounds_.push_back({sum, {.radius = limit}, 1 / (limit * limit), 2, drift_of(sum)});
}

void QuickestFit::place(const PointSum& sum, const Region& region) {
  if (is_all_free(sum)) rounds_.push_back({sum, region, 1 / (region.radius * region.radius), 0, Vector::Zero()});
}

template <class Use>
void QuickestFit::for_all_sides(Use use) {
  for (Box& box : boxes_) {
    use(box.above);
    use(box.below);
  }
  for (Round& round : rounds_) use(round.side);
}

bool QuickestFit::solve(const std::stop_token& stop) {
  inequalities_ = static_cast<double>(6 * boxes_.size() + rounds_.size());
  measure();
  set_slacks();
  for (int i = 0; i < kMostSteps; ++i) {
    throw_if_stopped(stop);
    if (!step()) return false;
    measure();
    if (gap_ < kGap && outside_ < kOutside) return true;
  }
  return false;
}

// What is farther inside than its slack says gets the slack that it has.
void QuickestFit::measure() {
  gap_ = 0;
  outside_ = 0;
  const auto add = [&](auto& side) {
    side.slack = side.slack.max(-side.excess);
    gap_ += (side.slack * side.multiplier).sum();
    outside_ = std::max(outside_, side.excess.maxCoeff());
  };
  for (Box& box : boxes_) {
    const Eigen::Array3d share = box.sum.of(points_).array() * box.per_limit;
    box.above.excess = share - 1 - (longer_ - 1) * box.growth_above;
    box.below.excess = -share - 1 - (longer_ - 1) * box.growth_below;
    add(box.above);
    add(box.below);
  }
  for (Round& round : rounds_) {
    const Vector away = round.across(round.sum.of(points_) + (longer_ - 1) * round.drift - round.region.origin);
    round.gradient = 2 * round.per_square * away;
    round.side.excess[0] = round.per_square * away.squaredNorm() - 1 - round.growth * (longer_ - 1);
    add(round.side);
  }
}

void QuickestFit::set_slacks() {
  gap_ = kFirstGap * std::sqrt(1 + outside_);
  for_all_sides([&](auto& side) {
    side.slack = (-side.excess).max(kLeastSlack);
    side.multiplier = gap_ / inequalities_ / side.slack;
  });
}

// First a step to where all slacks or multipliers would be zero: it shows how far one can aim, and what it neglects.
bool QuickestFit::step() {
  if (!assemble()) return false;
  for_all_sides([](auto& side) { side.target.setZero(); });
  find_change();
  const double target = cube(gap_after(shares_of_change()) / gap_) * gap_ / inequalities_;
  for_all_sides([&](auto& side) { side.target = target - side.slack_change * side.multiplier_change; });
  find_change();
  move(shares_of_change());
  return std::isfinite(longer_);
}

// Newton's equations, without the slacks and multipliers, which follow from the points and `longer`. That one is in
// nearly every equation: it is taken out of them by its border.
bool QuickestFit::assemble() {
  matrix_.reset(points_.size(), kHold);
  border_.assign(points_.size(), Vector::Zero());
  stiff_ = 0;
  for (const Box& box : boxes_) {
    const Eigen::Array3d above = stiffness(box.above), below = stiffness(box.below);
    const Eigen::Array3d grown_above = above * box.growth_above, grown_below = below * box.growth_below;
    matrix_.add(box.sum, Eigen::Array3d((above + below) * box.per_limit.square()));
    box.sum.spread(box.per_limit * (grown_below - grown_above), border_);
    stiff_ += (grown_above * box.growth_above + grown_below * box.growth_below).sum();
  }
  for (const Round& round : rounds_) {
    const double stiff = stiffness(round.side)[0];
    const Vector &direction = round.region.direction, &gradient = round.gradient;
    Eigen::Matrix3d block = -direction * direction.transpose();
    block.diagonal().array() += 1;
    block *= 2 * round.per_square * round.side.multiplier[0];
    block += stiff * gradient * gradient.transpose();
    matrix_.add(round.sum, block);
    if (round.growth == 0) continue;
    const Vector grown = block * round.drift - round.growth * stiff * gradient;
    round.sum.spread(grown, border_);
    stiff_ += round.drift.dot(grown) - round.growth * stiff * (gradient.dot(round.drift) - round.growth);
  }
  for (const std::size_t end : {std::size_t{0}, points_.size() - kHeldPoints}) {
    for (std::size_t held = end; held < end + kHeldPoints; ++held) {
      matrix_.hold(held);
      border_[held].setZero();
    }
  }
  if (!matrix_.factorize()) return false;
  along_border_ = border_;
  matrix_.solve(along_border_);
  for (std::size_t i = 0; i < border_.size(); ++i) stiff_ -= border_[i].dot(along_border_[i]);
  return true;
}

// Of the points and `longer`, to come to the targets.
void QuickestFit::find_change() {
  const std::size_t first_free = kHeldPoints, end_free = points_.size() - kHeldPoints;
  change_.assign(points_.size(), Vector::Zero());
  double forced = -1;  // what `longer` itself is worth
  for (const Box& box : boxes_) {
    const Eigen::Array3d above = force(box.above), below = force(box.below);
    box.sum.spread(box.per_limit * (below - above), change_);
    forced += (above * box.growth_above + below * box.growth_below).sum();
  }
  for (const Round& round : rounds_) {
    const double value = force(round.side)[0];
    round.sum.spread(-value * round.gradient, change_);
    forced += (round.growth - round.gradient.dot(round.drift)) * value;
  }
  const auto hold = [&] {
    std::fill(change_.begin(), change_.begin() + first_free, Vector::Zero());
    std::fill(change_.begin() + static_cast<std::ptrdiff_t>(end_free), change_.end(), Vector::Zero());
  };
  hold();
  matrix_.solve(change_);
  for (std::size_t i = first_free; i < end_free; ++i) forced -= border_[i].dot(change_[i]);
  change_of_longer_ = forced / stiff_;
  for (std::size_t i = first_free; i < end_free; ++i) change_[i] -= change_of_longer_ * along_border_[i];
  hold();
}

// With what the slacks and multipliers have to change.
QuickestFit::Shares QuickestFit::shares_of_change() {
  Shares shares;
  const auto find = [&](auto& side, const auto& change_of_excess) {
    side.slack_change = -(side.excess + side.slack) - change_of_excess;
    side.multiplier_change = (side.target - side.multiplier * side.slack_change) / side.slack - side.multiplier;
    shares.slacks = std::min(shares.slacks, longest(side.slack, side.slack_change));
    shares.multipliers = std::min(shares.multipliers, longest(side.multiplier, side.multiplier_change));
  };
  for (Box& box : boxes_) {
    const Eigen::Array3d moved = box.sum.of(change_).array() * box.per_limit;
    find(box.above, Eigen::Array3d(moved - change_of_longer_ * box.growth_above));
    find(box.below, Eigen::Array3d(-moved - change_of_longer_ * box.growth_below));
  }
  for (Round& round : rounds_) {
    const Vector moved = round.sum.of(change_) + change_of_longer_ * round.drift;
    find(round.side, round.gradient.dot(moved) - round.growth * change_of_longer_);
  }
  return shares;
}

double QuickestFit::gap_after(const Shares& shares) {
  double gap = 0;
  for_all_sides([&](auto& side) {
    gap += ((side.slack + shares.slacks * side.slack_change) *
            (side.multiplier + shares.multipliers * side.multiplier_change))
               .sum();
  });
  return gap;
}

void QuickestFit::move(const Shares& shares) {
  for_all_sides([&](auto& side) {
    side.slack += shares.slacks * side.slack_change;
    side.multiplier += shares.multipliers * side.multiplier_change;
  });
  for (std::size_t i = 0; i < points_.size(); ++i) points_[i] += shares.slacks * change_[i];
  longer_ += shares.slacks * change_of_longer_;
}

}  // namespace kcs::planning
