#include "server/planning/band_matrix.h"

#include <algorithm>

namespace kcs::planning {
namespace {

// On the diagonal: what belongs to it hardly moves.
constexpr double kHeld = 1e30;

double square(double value) { return value * value; }

}  // namespace

void BandMatrix::reset(std::size_t points, double diagonal) {
  size_ = kAxes * points;
  columns_.assign(size_, Column{diagonal});
  columns_.resize(size_ + kBand);
}

void BandMatrix::add(const PointSum& sum, const Eigen::Matrix3d& block) {
  for (std::size_t k = 0; k < sum.count; ++k) {
    Column* columns = &columns_[kAxes * (sum.first + k)];
    for (std::size_t b = 0; b < kAxes; ++b) {
      const double* entries = &block.data()[kAxes * b];
      for (std::size_t a = b; a < kAxes; ++a) columns[b][a - b] += square(sum.weights[k]) * entries[a];
      for (std::size_t i = k + 1; i < sum.count; ++i) {
        const double weight = sum.weights[i] * sum.weights[k];
        double* below = &columns[b][kAxes * (i - k) - b];
        for (std::size_t a = 0; a < kAxes; ++a) below[a] += weight * entries[a];
      }
    }
  }
}

void BandMatrix::add(const PointSum& sum, const Eigen::Array3d& diagonal) {
  for (std::size_t k = 0; k < sum.count; ++k) {
    Column* columns = &columns_[kAxes * (sum.first + k)];
    for (std::size_t i = k; i < sum.count; ++i) {
      const double weight = sum.weights[i] * sum.weights[k];
      for (std::size_t a = 0; a < kAxes; ++a) columns[a][kAxes * (i - k)] += weight * diagonal.data()[a];
    }
  }
}

void BandMatrix::hold(std::size_t point) {
  for (std::size_t a = 0; a < kAxes; ++a) columns_[kAxes * point + a][0] = kHeld;
}

bool BandMatrix::factorize() {
  for (std::size_t c = 0; c < size_; ++c) {
    Column& column = columns_[c];
    if (!(column[0] > 0)) return false;
    const double inverse = 1 / column[0];
    Column share;
    for (std::size_t d = 0; d < kBand; ++d) share[d] = inverse * column[d];
    for (std::size_t d = 1; d < kBand; ++d) {
      Column& next = columns_[c + d];
      for (std::size_t e = d; e < kBand; ++e) next[e - d] -= share[d] * column[e];
    }
    share[0] = inverse;
    column = share;
  }
  return true;
}

void BandMatrix::solve(std::vector<Vector>& values) const {
  double* x = values.front().data();
  for (std::size_t c = 0; c < size_; ++c) {
    const std::size_t most = std::min(kBand, size_ - c);
    for (std::size_t d = 1; d < most; ++d) x[c + d] -= columns_[c][d] * x[c];
  }
  for (std::size_t c = size_; c-- > 0;) {
    double value = columns_[c][0] * x[c];
    // What was found last comes last: nothing else has to wait for it.
    for (std::size_t d = std::min(kBand, size_ - c); d-- > 1;) value -= columns_[c][d] * x[c + d];
    x[c] = value;
  }
}

}  // namespace kcs::planning
