// Points at equal steps of time that are near to given ones and change their motion little.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "server/motion/phase.h"

namespace kcs::planning {

using motion::Vector;

// How much each point of a fit is held, ≥ 0; one entry per point.
struct FitWeights {
  void resize(std::size_t size);
  // Entry k becomes what lies at a share of the way from entry i of others to the next.
  void set_between(std::size_t k, const FitWeights& others, std::size_t i, double share);

  std::vector<double> place;         // of its distance from its datum
  std::vector<double> acceleration;  // of the second difference that begins at it; the last two are not used
  std::vector<Vector> jerk;  // of the third difference that begins at it, axis by axis; the last three are not used
};

// Finds the points r that minimise Σ place_i |r_i − data_i|² + Σ acceleration_i |r_{i+2} − 2 r_{i+1} + r_i|²
// + Σ jerk_i |r_{i+3} − 3 r_{i+2} + 3 r_{i+1} − r_i|²: a linear system with three bands beside its diagonal, solved by
// LDLᵀ in time and memory linear in the number of points. Keeps its memory from one fit to the next.
class PenalizedFit {
 public:
  // As many weights as data; at least three places are more than 0. Overwrites result, which may not be data.
  // alike: each jerk weight is the same for all axes; then one system is solved for all of them.
  void solve(const FitWeights& weights, bool alike, std::span<const Vector> data, std::vector<Vector>& result);

 private:
  using Axes = Eigen::Array3d;
  // A row of the factors, of all axes or of each: the inverse of its diagonal, and its entries 1, 2 and 3 before the
  // diagonal.
  template <class Entry>
  struct Row {
    Entry inverse, l1, l2, l3;
  };

  template <class Entry>
  static void substitute_forward(const FitWeights& weights, std::span<const Vector> data, std::vector<Row<Entry>>& rows,
                                 std::vector<Vector>& result);
  template <class Entry>
  static void substitute_backward(const std::vector<Row<Entry>>& rows, std::vector<Vector>& result);

  std::vector<Row<double>> rows_;
  std::vector<Row<Axes>> axes_rows_;
};

}  // namespace kcs::planning
