#include "server/runs/polynomial.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace kcs::runs {
namespace {

// Halves of halves so often; what is undecided then is as good as beyond.
constexpr int kMostHalvings = 24;

}  // namespace

Polynomial::Polynomial(std::initializer_list<double> coefficients) : size_(coefficients.size()) {
  std::copy(coefficients.begin(), coefficients.end(), coefficients_.begin());
}

Polynomial operator+(const Polynomial& a, const Polynomial& b) {
  Polynomial sum(std::max(a.size_, b.size_));
  for (std::size_t i = 0; i < sum.size_; ++i) sum.coefficients_[i] = a.coefficients_[i] + b.coefficients_[i];
  return sum;
}

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  Polynomial product(a.size_ + b.size_ - 1);
  assert(product.size_ <= Polynomial::kMost);
  for (std::size_t i = 0; i < a.size_; ++i) {
    for (std::size_t k = 0; k < b.size_; ++k) product.coefficients_[i + k] += a.coefficients_[i] * b.coefficients_[k];
  }
  return product;
}

Polynomial operator*(double factor, const Polynomial& a) {
  Polynomial product = a;
  for (double& coefficient : product.coefficients_) coefficient *= factor;
  return product;
}

bool Polynomial::is_within(double most, double end) const {
  // In the power basis on [0, 1], then b_k = Σ_i C(k, i) / C(n, i) c_i by repeated sums.
  Coefficients bernstein = coefficients_;
  const std::size_t degree = size_ - 1;
  double power = 1, binomial = 1;
  for (std::size_t i = 0; i <= degree; ++i) {
    bernstein[i] *= power / binomial;
    power *= end;
    binomial *= static_cast<double>(degree - i) / static_cast<double>(i + 1);
  }
  for (std::size_t i = 0; i < degree; ++i) {
    for (std::size_t k = degree; k > i; --k) bernstein[k] += bernstein[k - 1];
  }
  return is_within(bernstein, size_, most, kMostHalvings);
}

bool Polynomial::is_within(const Coefficients& bernstein, std::size_t size, double most, int depth) {
  const auto inside = [most](double value) { return std::abs(value) <= most; };
  if (!inside(bernstein[0]) || !inside(bernstein[size - 1])) return false;  // these two are values
  if (std::all_of(bernstein.begin(), bernstein.begin() + static_cast<std::ptrdiff_t>(size), inside)) return true;
  if (depth == 0) return false;
  Coefficients left{}, right = bernstein;  // by de Casteljau
  for (std::size_t i = 0; i < size; ++i) {
    left[i] = right[0];
    for (std::size_t k = 0; k + 1 + i < size; ++k) right[k] = (right[k] + right[k + 1]) / 2;
  }
  return is_within(left, size, most, depth - 1) && is_within(right, size, most, depth - 1);
}

}  // namespace kcs::runs
