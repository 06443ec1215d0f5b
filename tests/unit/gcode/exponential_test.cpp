// Exponential, logarithm and power against the C library's in long double, and to the bit.
#include "server/gcode/exponential.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "server/gcode/precise.h"

namespace kcs::gcode {
namespace {

static_assert(std::numeric_limits<long double>::digits >= 64, "long double must be the more accurate one");

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kAccuracy = 0.501;  // units in the last place; nothing that is rounded to a double has less than 0.5

double error(double value, long double exact) {
  const double nearest = std::abs(static_cast<double>(exact));
  const double unit = std::nextafter(nearest, kInfinity) - nearest;
  return static_cast<double>(std::abs(value - exact) / unit);
}

TEST(Exponential, IsAccurate) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-700, 700);
  std::uniform_real_distribution<double> small(-1, 1);
  double largest = 0;
  for (int round = 0; round < 100'000; ++round) {
    for (const double x : {exponent(random), small(random), small(random) * 1e-9}) {
      largest = std::max(largest, error(exponential(x), std::exp(static_cast<long double>(x))));
    }
  }
  EXPECT_LE(largest, kAccuracy);
}

TEST(Exponential, EndsAtTheRangeOfADouble) {
  EXPECT_EQ(exponential(0), 1);
  EXPECT_LT(exponential(709.78), kInfinity);
  EXPECT_EQ(exponential(709.79), kInfinity);
  EXPECT_EQ(exponential(1e300), kInfinity);
  EXPECT_EQ(exponential(-745), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(exponential(-746), 0);
  EXPECT_EQ(exponential(-1e300), 0);
}

TEST(Logarithm, IsAccurate) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> exponent(-300, 300);
  std::uniform_real_distribution<double> around(0.5, 2);
  std::uniform_real_distribution<double> distance(-1, 1);
  double largest = 0;
  for (int round = 0; round < 100'000; ++round) {
    for (const double x : {std::pow(10, exponent(random)), around(random), 1 + distance(random) * 1e-6}) {
      if (x != 1) largest = std::max(largest, error(logarithm(x), std::log(static_cast<long double>(x))));
    }
  }
  EXPECT_LE(largest, kAccuracy);
}

TEST(Logarithm, ReachesToTheEndsOfADouble) {
  EXPECT_EQ(logarithm(1), 0);
  EXPECT_EQ(logarithm(std::numeric_limits<double>::max()), 709.782712893384);
  EXPECT_EQ(logarithm(std::numeric_limits<double>::denorm_min()), -744.4400719213812);
}

TEST(Power, IsAccurate) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> base(-20, 20);
  std::uniform_real_distribution<double> exponent(-30, 30);
  double largest = 0;
  for (int round = 0; round < 100'000; ++round) {
    const double b = std::exp(base(random));
    const double e = exponent(random);
    largest = std::max(largest, error(power(b, e), std::pow(static_cast<long double>(b), static_cast<long double>(e))));
  }
  EXPECT_LE(largest, kAccuracy);
}

TEST(Power, IsExactWhereTheResultIs) {
  for (int base = -9; base <= 9; ++base) {
    double product = 1;
    for (int exponent = 0; exponent <= 16; ++exponent, product *= base) {
      EXPECT_EQ(power(base, exponent), product) << base << "**" << exponent;
    }
  }
  for (int root = 1; root < 2000; ++root) EXPECT_EQ(power(1.0 * root * root, 0.5), root);
  EXPECT_EQ(power(2, -1074), std::numeric_limits<double>::denorm_min());
}

TEST(Power, HasItsSpecialCases) {
  EXPECT_EQ(power(0, 0), 1);
  EXPECT_EQ(power(0, 0.5), 0);
  EXPECT_EQ(power(0, -1), kInfinity);
  EXPECT_EQ(power(1, 1e300), 1);
  EXPECT_EQ(power(-1, 1e300), 1);
  EXPECT_EQ(power(-2, -3), -0.125);
  EXPECT_EQ(power(10, 309), kInfinity);
  EXPECT_EQ(power(-10, 309), -kInfinity);
  EXPECT_EQ(power(10, -330), 0);
  EXPECT_EQ(power(1e-300, 1e300), 0);
  EXPECT_EQ(power(1 + 1e-15, 1e300), kInfinity);
}

// The sum of the bits of many results: a machine on which any of them is different does not repeat it.
TEST(Exponential, GivesTheSameBitsOnEveryMachine) {
  std::uint64_t sum = 0;
  const auto add = [&sum](double value) { sum = sum * 31 + std::bit_cast<std::uint64_t>(value); };
  for (int step = 1; step <= 20'000; ++step) {
    add(exponential(step / 64.0 - 150));
    add(logarithm(step / 1024.0));
    add(power(step / 512.0, 7 - step / 2048.0));
  }
  EXPECT_EQ(sum, 4'322'793'345'416'192'456U);
}

TEST(Precise, SumsAndProductsOfDoublesAreExact) {
  const Precise sum = exact_sum(1, 0x1p-80);
  EXPECT_EQ(sum.value, 1);
  EXPECT_EQ(sum.rest, 0x1p-80);
  const Precise square = exact_product(1 + 0x1p-30, 1 + 0x1p-30);
  EXPECT_EQ(square.value, 1 + 0x1p-29);
  EXPECT_EQ(square.rest, 0x1p-60);
}

TEST(Precise, QuotientsMultiplyBackToMoreThanADoublesDigits) {
  const Precise third = Precise{1} / Precise{3};
  EXPECT_EQ(third.value, 1.0 / 3);
  EXPECT_EQ(third.rest, 0x1.5555555555555p-56);  // 1/3 is 0.010101… in binary
  const Precise remainder = third * Precise{3} - Precise{1};
  EXPECT_LE(std::abs(remainder.value), 1e-31);
}

}  // namespace
}  // namespace kcs::gcode
