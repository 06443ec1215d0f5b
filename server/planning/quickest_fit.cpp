#include "server/planning/quickest_fit.h"

#include <algorithm>
#include <cmath>

#include "server/planning/stopped.h"

namespace kcs::planning {
namespace {

constexpr std::size_t kHeldPoints = 3;  // at either end
constexpr int kMostSteps = 50;
// At first: t, the least slack, and all slacks times their multipliers.
constexpr double kFirst = 1.05, kLeastSlack = 0.03, kFirstGap = 0.5;
// In the end: slacks times multipliers, which is how much less t could be, and what is outside.
constexpr double kGap = 0.01, kOutside = 3e-3;
// A step takes slacks and multipliers no nearer to zero than by this share.
constexpr double kNearest = 0.99;
// What held points take part in has this much of its distance, squared, as its limit, inverted.
constexpr double kShareOfHeld = 0.999;
// The next step aims at this share of the gap where the last one went nearly all the way, where it went half of it, and
// where it was shorter.
constexpr double kBold = 0.05, kCautious = 0.2, kCentering = 0.6;

// What the gradients of inequalities are taken times, in the matrix and on the right side.
template <class Side>
typename Side::Numbers stiffness(const Side& side) {
  return side.multiplier / side.slack;
}
template <class Side>
typename Side::Numbers force(const Side& side, double target) {
  return (target + side.multiplier * (side.excess + side.slack)) / side.slack;
}
template <class Side>
typename Side::Numbers change_of_multiplier(const Side& side, double target) {
  return (target - side.multiplier * side.change) / side.slack - side.multiplier;
}

// The share of a change, up to all of it, that leaves positive values positive.
template <class Numbers>
double longest(const Numbers& values, const Numbers& change) {
  return kNearest / std::max(kNearest, (-change / values).maxCoeff());
}

}  // namespace

void QuickestFit::begin(std::span<const Vector> points) {
  points_.assign(points.begin(), points.end());
  t_ = kFirst;
  boxes_.clear();
  rounds_.clear();
}

bool QuickestFit::is_free(const PointSum& sum) const {
  return sum.first + sum.count > kHeldPoints && sum.first + kHeldPoints < points_.size();
}

bool QuickestFit::is_all_free(const PointSum& sum) const {
  return sum.first >= kHeldPoints && sum.first + sum.count + kHeldPoints <= points_.size();
}

Vector QuickestFit::Round::away(const std::vector<Vector>& points) const {
  const Vector from = sum.of(points) - region.origin;
  return from - from.dot(region.direction) * region.direction;
}

void QuickestFit::limit_axes(const PointSum& sum, const Vector& limit, Kind kind) {
  if (is_free(sum)) boxes_.push_back({sum, limit.array().inverse(), static_cast<double>(kind) / 3});
}

void QuickestFit::limit_speed(const PointSum& sum, double limit) {
  if (is_free(sum)) rounds_.push_back({sum, {.radius = limit}, 1 / (limit * limit), 2.0 / 3});
}

void QuickestFit::place(const PointSum& sum, const Region& region) {
  if (!is_free(sum)) return;
  Round round{sum, region, 1 / (region.radius * region.radius), 0};
  if (!is_all_free(sum))
    round.per_square = std::min(round.per_square, kShareOfHeld / round.away(points_).squaredNorm());
  rounds_.push_back(round);
}

bool QuickestFit::solve(const std::stop_token& stop) {
  inequalities_ = static_cast<double>(6 * boxes_.size() + rounds_.size());
  centering_ = kCautious;
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
    const double allowed = 1 + box.per_t * (t_ - 1);
    box.above.excess = share - allowed;
    box.below.excess = -share - allowed;
    add(box.above);
    add(box.below);
  }
  for (Round& round : rounds_) {
    const Vector away = round.away(points_);
    round.gradient = 2 * round.per_square * away;
    round.side.excess[0] = round.per_square * away.squaredNorm() - 1 - round.per_t * (t_ - 1);
    add(round.side);
  }
}

void QuickestFit::set_slacks() {
  const auto set = [&](auto& side) {
    side.slack = (-side.excess).max(kLeastSlack);
    side.multiplier = kFirstGap / inequalities_ / side.slack;
  };
  for (Box& box : boxes_) {
    set(box.above);
    set(box.below);
  }
  for (Round& round : rounds_) set(round.side);
  gap_ = kFirstGap;
}

bool QuickestFit::step() {
  const double target = centering_ * gap_ / inequalities_;
  const Corner corner = assemble(target);
  if (!matrix_.factorize()) return false;
  move(target, find_change(corner));
  return std::isfinite(t_);
}

// Newton's equations for the points and t, without the slacks and multipliers, which follow from them.
QuickestFit::Corner QuickestFit::assemble(double target) {
  const std::size_t size = points_.size();
  matrix_.reset(size);
  border_.assign(size, Vector::Zero());
  change_.assign(size, Vector::Zero());
  Corner corner{0, -1};
  const auto spread = [](const PointSum& sum, const Vector& value, std::vector<Vector>& to) {
    for (std::size_t i = 0; i < sum.count; ++i) to[sum.first + i] += sum.weights[i] * value;
  };
  for (const Box& box : boxes_) {
    const Eigen::Array3d stiff_above = stiffness(box.above), stiff_below = stiffness(box.below);
    const Eigen::Array3d force_above = force(box.above, target), force_below = force(box.below, target);
    const Eigen::Array3d both = stiff_above + stiff_below;
    matrix_.add(box.sum, Eigen::Array3d(both * box.per_limit.square()));
    spread(box.sum, -box.per_t * (box.per_limit * (stiff_above - stiff_below)).matrix(), border_);
    spread(box.sum, (box.per_limit * (force_below - force_above)).matrix(), change_);
    corner.matrix += box.per_t * box.per_t * both.sum();
    corner.right += box.per_t * (force_above + force_below).sum();
  }
  for (const Round& round : rounds_) {
    const double stiff = stiffness(round.side)[0], forced = force(round.side, target)[0];
    const Vector &direction = round.region.direction, &gradient = round.gradient;
    Eigen::Matrix3d block = -direction * direction.transpose();
    block.diagonal().array() += 1;
    block *= 2 * round.per_square * round.side.multiplier[0];
    block += stiff * gradient * gradient.transpose();
    matrix_.add(round.sum, block);
    spread(round.sum, -forced * gradient, change_);
    if (round.per_t == 0) continue;
    spread(round.sum, -round.per_t * stiff * gradient, border_);
    corner.matrix += round.per_t * round.per_t * stiff;
    corner.right += round.per_t * forced;
  }
  for (std::size_t i = 0; i < kHeldPoints; ++i) {
    for (const std::size_t held : {i, size - 1 - i}) {
      matrix_.hold(held);
      border_[held] = change_[held] = Vector::Zero();
    }
  }
  return corner;
}

// t is in nearly every equation: it is taken out of them by its border. Returns its change.
double QuickestFit::find_change(const Corner& corner) {
  along_border_ = border_;
  matrix_.solve(along_border_);
  matrix_.solve(change_);
  double stiff = corner.matrix, forced = corner.right;
  for (std::size_t i = 0; i < border_.size(); ++i) {
    stiff -= border_[i].dot(along_border_[i]);
    forced -= border_[i].dot(change_[i]);
  }
  const double change_of_t = forced / stiff;
  for (std::size_t i = kHeldPoints; i + kHeldPoints < change_.size(); ++i) change_[i] -= change_of_t * along_border_[i];
  return change_of_t;
}

void QuickestFit::move(double target, double change_of_t) {
  double share = 1, share_of_multipliers = 1;
  const auto find_share = [&](auto& side, const auto& change_of_excess) {
    side.change = -(side.excess + side.slack) - change_of_excess;
    share = std::min(share, longest(side.slack, side.change));
    share_of_multipliers = std::min(share_of_multipliers, longest(side.multiplier, change_of_multiplier(side, target)));
  };
  for (Box& box : boxes_) {
    const Eigen::Array3d moved = box.sum.of(change_).array() * box.per_limit;
    const double allowed = box.per_t * change_of_t;
    find_share(box.above, Eigen::Array3d(moved - allowed));
    find_share(box.below, Eigen::Array3d(-moved - allowed));
  }
  for (Round& round : rounds_) {
    find_share(round.side, round.gradient.dot(round.sum.of(change_)) - round.per_t * change_of_t);
  }
  const auto move_side = [&](auto& side) {
    const auto multiplier = change_of_multiplier(side, target);
    side.slack += share * side.change;
    side.multiplier += share_of_multipliers * multiplier;
  };
  for (Box& box : boxes_) {
    move_side(box.above);
    move_side(box.below);
  }
  for (Round& round : rounds_) move_side(round.side);
  for (std::size_t i = kHeldPoints; i + kHeldPoints < points_.size(); ++i) points_[i] += share * change_[i];
  t_ += share * change_of_t;
  const double both = std::min(share, share_of_multipliers);
  centering_ = both > 0.9 ? kBold : both > 0.5 ? kCautious : kCentering;
}

}  // namespace kcs::planning
