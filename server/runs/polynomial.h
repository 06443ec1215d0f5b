// Polynomials of some degree, and bounds of their values.
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>

namespace kcs::runs {

// c0 + c1 t + c2 t² + …, up to degree 9. What would be of a higher degree must not come up.
class Polynomial {
 public:
  Polynomial(std::initializer_list<double> coefficients);

  friend Polynomial operator+(const Polynomial& a, const Polynomial& b);
  friend Polynomial operator*(const Polynomial& a, const Polynomial& b);
  friend Polynomial operator*(double factor, const Polynomial& a);

  // Whether its magnitude is at most `most` for all t from 0 to `end`. By its Bernstein coefficients, which bound it,
  // on halves of halves if need be.
  bool is_within(double most, double end) const;

 private:
  static constexpr std::size_t kMost = 10;
  using Coefficients = std::array<double, kMost>;

  explicit Polynomial(std::size_t size) : size_(size) {}

  static bool is_within(const Coefficients& bernstein, std::size_t size, double most, int depth);

  Coefficients coefficients_{};
  std::size_t size_;
};

}  // namespace kcs::runs
