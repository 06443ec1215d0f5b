#include "server/planning/penalized_fit.h"

#include <cstddef>
#include <type_traits>

namespace kcs::planning {
namespace {

// What once moved an axis dies away by a share with every point, until numbers are so small that processors become
// slow. It dies away to this instead, which is as good as nothing.
constexpr double kNothing = 1e-100;

// An axis that never moves stays at zero.
Vector trace(std::span<const Vector> data) {
  Vector largest = Vector::Zero();
  for (const Vector& point : data) largest = largest.cwiseMax(point.cwiseAbs());
  return (largest.array() > 0).select(Vector::Constant(kNothing), 0);
}

template <class Entry>
Entry entry_of(const Vector& weight) {
  if constexpr (std::is_same_v<Entry, double>) {
    return weight.x();
  } else {
    return weight.array();
  }
}

}  // namespace

void FitWeights::resize(std::size_t size) {
  place.resize(size);
  acceleration.resize(size);
  jerk.resize(size);
}

void FitWeights::set_between(std::size_t k, const FitWeights& others, std::size_t i, double share) {
  const auto set = [&](auto& mine, const auto& values) { mine[k] = values[i] + share * (values[i + 1] - values[i]); };
  set(place, others.place);
  set(acceleration, others.acceleration);
  set(jerk, others.jerk);
}

// Row by row: what the row has before its diagonal, and the first substitution. A row waits for the inverse of the one
// before it; everything else that it needs is known by then.
template <class Entry>
void PenalizedFit::substitute_forward(const FitWeights& weights, std::span<const Vector> data,
                                      std::vector<Row<Entry>>& rows, std::vector<Vector>& result) {
  const std::size_t size = data.size();
  rows.resize(size);
  const auto zero = entry_of<Entry>(Vector::Zero());
  // Of the rows one, two and three before.
  Row<Entry> one{zero, zero, zero, zero}, two = one, three = one;
  Entry entry11 = zero, entry12 = zero,
        entry21 = zero;   // their entries times their diagonals: 1 of one and two, 2 of one
  double a1 = 0, a2 = 0;  // their weights
  Entry j1 = zero, j2 = zero, j3 = zero;
  const Axes nothing = trace(data);
  Axes v1 = Axes::Zero(), v2 = v1, v3 = v1;
  for (std::size_t i = 0; i < size; ++i) {
    const double a0 = i + 2 < size ? weights.acceleration[i] : 0;
    const Entry j0 = i + 3 < size ? entry_of<Entry>(weights.jerk[i]) : zero;
    const Entry entry3 = -j3;
    const Entry l3 = entry3 * three.inverse;
    const Entry entry2 = a2 + 3 * (j2 + j3) - l3 * entry12;
    const Entry l2 = entry2 * two.inverse;
    const Entry entry1 = -2 * (a1 + a2) - 3 * (j1 + j3) - 9 * j2 - l3 * entry21 - l2 * entry11;
    const Entry l1 = entry1 * one.inverse;
    const Entry diagonal = weights.place[i] + a0 + 4 * a1 + a2 + j0 + 9 * (j1 + j2) + j3;
    const Row<Entry> row{1 / (diagonal - l3 * entry3 - l2 * entry2 - l1 * entry1), l1, l2, l3};
    const Axes value = weights.place[i] * data[i].array() + nothing - l3 * v3 - l2 * v2 - l1 * v1;
    rows[i] = row;
    result[i] = value;
    three = two, two = one, one = row;
    entry12 = entry11, entry11 = entry1, entry21 = entry2;
    a2 = a1, a1 = a0, j3 = j2, j2 = j1, j1 = j0;
    v3 = v2, v2 = v1, v1 = value;
  }
}

template <class Entry>
void PenalizedFit::substitute_backward(const std::vector<Row<Entry>>& rows, std::vector<Vector>& result) {
  const auto zero = entry_of<Entry>(Vector::Zero());
  Row<Entry> one{zero, zero, zero, zero}, two = one, three = one;  // rows after
  Axes v1 = Axes::Zero(), v2 = v1, v3 = v1;
  for (std::size_t i = result.size(); i-- > 0;) {
    const Axes value = rows[i].inverse * result[i].array() - three.l3 * v3 - two.l2 * v2 - one.l1 * v1;
    result[i] = value;
    three = two, two = one, one = rows[i];
    v3 = v2, v2 = v1, v1 = value;
  }
}

void PenalizedFit::solve(const FitWeights& weights, bool alike, std::span<const Vector> data,
                         std::vector<Vector>& result) {
  result.resize(data.size());
  const auto solve_with = [&](auto& rows) {
    substitute_forward(weights, data, rows, result);
    substitute_backward(rows, result);
  };
  if (alike) {
    solve_with(rows_);
  } else {
    solve_with(axes_rows_);
  }
}

}  // namespace kcs::planning
