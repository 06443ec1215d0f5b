// A linear system for points in a row, in which each has to do with the three before it and the three after it.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "server/motion/phase.h"

namespace kcs::planning {

using motion::Vector;

// Σ weights_i · point_{first + i}: what a spline does is such a sum of four of its points.
struct PointSum {
  std::size_t first = 0;
  std::size_t count = 0;  // ≤ 4
  std::array<double, 4> weights = {};

  Vector of(std::span<const Vector> points) const {
    Vector result = Vector::Zero();
    for (std::size_t i = 0; i < count; ++i) result += weights[i] * points[first + i];
    return result;
  }

  // Adds weights_i · value to each of its points.
  void spread(const Vector& value, std::span<Vector> points) const {
    for (std::size_t i = 0; i < count; ++i) points[first + i] += weights[i] * value;
  }
};

// Symmetric; three rows for each point, one for each axis. What is not near to the diagonal is zero and takes no memory
// and no time.
class BandMatrix {
 public:
  // All zero but the diagonal: what nothing is added to stays solvable.
  void reset(std::size_t points, double diagonal = 0);

  // Adds weights_i · weights_k · block where the points i and k of the sum meet: the second derivative of a function of
  // the sum is made of these. `block` is symmetric.
  void add(const PointSum& sum, const Eigen::Matrix3d& block);
  // The same with a diagonal block.
  void add(const PointSum& sum, const Eigen::Array3d& diagonal);

  // The point is zero in what solve() finds.
  void hold(std::size_t point);

  // LDLᵀ. To be called once, after all of the above. False if the matrix is not positive definite.
  bool factorize();

  // Replaces the right side, an entry per point, by the solution.
  void solve(std::vector<Vector>& values) const;

 private:
  static constexpr std::size_t kAxes = 3, kBand = 12;
  using Column = std::array<double, kBand>;  // from the diagonal on; of the factors, with the inverse of the diagonal

  std::vector<Column> columns_;  // and kBand more, which are zero: the band reaches beyond the end
  std::size_t size_ = 0;
};

}  // namespace kcs::planning
