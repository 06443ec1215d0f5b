#include "server/planning/penalized_fit.h"

#include <cstddef>

namespace kcs::planning {
namespace {

// Adds weight times the square of a difference that begins at row `first`.
template <std::size_t size>
void add(std::array<double, 4>* rows, double weight, const std::array<double, size>& difference) {
  for (std::size_t a = 0; a < size; ++a) {
    for (std::size_t b = 0; b <= a; ++b) rows[a][a - b] += weight * difference[a] * difference[b];
  }
}

}  // namespace

void PenalizedFit::assemble(const FitWeights& weights) {
  constexpr std::array<double, 3> kSecond = {1, -2, 1};
  constexpr std::array<double, 4> kThird = {-1, 3, -3, 1};
  const std::size_t size = weights.place.size();
  factor_.assign(size, {});
  for (std::size_t i = 0; i < size; ++i) {
    factor_[i][0] += weights.place[i];
    if (i + 2 < size) add(&factor_[i], weights.acceleration[i], kSecond);
    if (i + 3 < size) add(&factor_[i], weights.jerk[i], kThird);
  }
}

// The first rows have zeros where there is no row before them; so there is nothing to ask.
void PenalizedFit::factorize() {
  constexpr std::array<double, 4> kNone = {};
  std::array<double, 4> one = kNone, two = kNone, three = kNone;  // rows before, with the inverse of their diagonals
  double d1 = 0, d2 = 0, d3 = 0;                                  // their diagonals
  for (auto& row : factor_) {
    const double l3 = row[3] * three[0];
    const double l2 = (row[2] - l3 * d3 * two[1]) * two[0];
    const double l1 = (row[1] - l3 * d3 * one[2] - l2 * d2 * one[1]) * one[0];
    const double diagonal = row[0] - l3 * l3 * d3 - l2 * l2 * d2 - l1 * l1 * d1;
    row = {1 / diagonal, l1, l2, l3};
    three = two, two = one, one = row;
    d3 = d2, d2 = d1, d1 = diagonal;
  }
}

void PenalizedFit::solve(const FitWeights& weights, std::span<const Vector> data, std::vector<Vector>& result) {
  assemble(weights);
  factorize();
  const std::size_t size = data.size();
  result.resize(size);
  Vector one = Vector::Zero(), two = one, three = one;
  for (std::size_t i = 0; i < size; ++i) {
    const auto& row = factor_[i];
    const Vector rest = weights.place[i] * data[i] - row[1] * one - row[2] * two - row[3] * three;
    result[i] = rest;
    three = two, two = one, one = rest;
  }
  one = two = three = Vector::Zero();
  for (std::size_t i = size; i-- > 0;) {
    Vector value = result[i] * factor_[i][0];
    if (i + 1 < size) value -= factor_[i + 1][1] * one;
    if (i + 2 < size) value -= factor_[i + 2][2] * two;
    if (i + 3 < size) value -= factor_[i + 3][3] * three;
    result[i] = value;
    three = two, two = one, one = value;
  }
}

}  // namespace kcs::planning
