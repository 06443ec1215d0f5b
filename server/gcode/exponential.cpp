#include "server/gcode/exponential.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "server/gcode/precise.h"

namespace kcs::gcode {
namespace {

using std::numbers::ln2;
using std::numbers::sqrt2;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Precise kOne{1};
constexpr Precise kLn2{ln2, 2.3190468138462996e-17};
// e to the power of this, or of less than its negative, is no double.
constexpr double kLargestExponent = 750;

// 1/first, 1/(first + step), …
template <std::size_t count>
constexpr std::array<Precise, count> reciprocals(double first, double step) {
  std::array<Precise, count> list;
  for (std::size_t i = 0; i < count; ++i) list[i] = kOne / Precise{first + step * static_cast<double>(i)};
  return list;
}

// What these many terms leave out is below 1e-32: of the exponential up to ln 2 / 2, and of the logarithm within √2.
constexpr std::array kExponential = reciprocals<25>(1, 1);
constexpr std::array kLogarithm = reciprocals<22>(1, 2);

// With x = m 2^k and s = (m − 1) / (m + 1), ln x = k ln 2 + 2 (s + s³/3 + s⁵/5 + …).
Precise precise_logarithm(double x) {
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent);
  if (mantissa < sqrt2 / 2) {
    mantissa *= 2;
    --exponent;
  }
  const Precise ratio = exact_sum(mantissa, -1) / exact_sum(mantissa, 1);
  const Precise square = ratio * ratio;
  Precise sum;
  for (std::size_t term = kLogarithm.size(); term-- > 0;) sum = sum * square + kLogarithm[term];
  return Precise{static_cast<double>(exponent)} * kLn2 + Precise{2} * ratio * sum;
}

// With x = k ln 2 + r, e^x = 2^k (1 + r + r²/2! + …). |x| ≤ kLargestExponent.
double exponential_of(Precise x) {
  const double exponent = std::round(x.value / ln2);
  const Precise remainder = x - Precise{exponent} * kLn2;
  Precise sum = kOne;
  for (std::size_t term = kExponential.size(); term-- > 0;) sum = kOne + remainder * sum * kExponential[term];
  return std::ldexp(sum.value, static_cast<int>(exponent));
}

}  // namespace

double exponential(double x) {
  if (std::abs(x) > kLargestExponent) return x > 0 ? kInfinity : 0;
  return exponential_of({x});
}

double logarithm(double x) { return precise_logarithm(x).value; }

double power(double base, double exponent) {
  if (exponent == 0) return 1;
  if (base == 0) return exponent > 0 ? 0 : kInfinity;
  const Precise log = precise_logarithm(std::abs(base));
  const double sign = base < 0 && std::fmod(exponent, 2) != 0 ? -1 : 1;
  const double estimate = log.value * exponent;
  if (std::abs(estimate) > kLargestExponent) return estimate > 0 ? sign * kInfinity : 0;
  return sign * exponential_of(log * Precise{exponent});
}

}  // namespace kcs::gcode
