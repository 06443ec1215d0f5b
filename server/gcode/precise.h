// Numbers of twice a double's precision, for steps whose rounding would show in a result.
#pragma once

namespace kcs::gcode {

// value + rest, where value is the double nearest to that sum. The operations are within about 1e-31 of their results,
// if all of these lie between 1e-250 and 1e250 in magnitude. Like all of kcs they need a compiler that does not fuse
// multiplication and addition.
struct Precise {
  double value = 0;
  double rest = 0;
};

// a + b exactly, for |a| ≥ |b| or a = 0.
constexpr Precise ordered_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

// a + b exactly (Knuth).
constexpr Precise exact_sum(double a, double b) {
  const double sum = a + b;
  const double part_of_b = sum - a;
  return {sum, (a - (sum - part_of_b)) + (b - part_of_b)};
}

// a × b exactly (Dekker): each factor is split into halves, whose products are exact.
constexpr Precise exact_product(double a, double b) {
  constexpr double kSplit = 0x1p27 + 1;
  const double upper_a = a * kSplit - (a * kSplit - a);
  const double upper_b = b * kSplit - (b * kSplit - b);
  const double lower_a = a - upper_a;
  const double lower_b = b - upper_b;
  const double product = a * b;
  return {product, ((upper_a * upper_b - product) + upper_a * lower_b + lower_a * upper_b) + lower_a * lower_b};
}

constexpr Precise operator-(Precise a) { return {-a.value, -a.rest}; }

constexpr Precise operator+(Precise a, Precise b) {
  const Precise values = exact_sum(a.value, b.value);
  const Precise rests = exact_sum(a.rest, b.rest);
  const Precise sum = ordered_sum(values.value, values.rest + rests.value);
  return ordered_sum(sum.value, sum.rest + rests.rest);
}

constexpr Precise operator-(Precise a, Precise b) { return a + -b; }

constexpr Precise operator*(Precise a, Precise b) {
  const Precise product = exact_product(a.value, b.value);
  return ordered_sum(product.value, product.rest + (a.value * b.rest + a.rest * b.value));
}

constexpr Precise operator/(Precise a, Precise b) {
  const double first = a.value / b.value;
  const Precise left = a - b * Precise{first};
  const double second = left.value / b.value;
  const double third = (left - b * Precise{second}).value / b.value;
  return ordered_sum(first, second) + Precise{third};
}

}  // namespace kcs::gcode
