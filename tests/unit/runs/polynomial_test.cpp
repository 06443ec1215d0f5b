#include "server/runs/polynomial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace kcs::runs {
namespace {

TEST(Polynomial, IsBoundedByItsExtremesAndNotByItsCoefficients) {
  const Polynomial parabola{0, 4, -4};  // 1 at 1/2
  EXPECT_TRUE(parabola.is_within(1, 1));
  EXPECT_FALSE(parabola.is_within(1 - 1e-6, 1));
  EXPECT_TRUE(parabola.is_within(0.75, 0.25));
  EXPECT_FALSE(parabola.is_within(0.75, 0.26));
  EXPECT_FALSE(parabola.is_within(1, 2)) << "-8 at 2";
}

TEST(Polynomial, ConstantsAreInsideWhatTheyAre) {
  EXPECT_TRUE(Polynomial{-3}.is_within(3, 1));
  EXPECT_FALSE(Polynomial{-3}.is_within(2.999, 1));
}

TEST(Polynomial, ProductsAndSumsAreThoseOfTheValues) {
  // (1 + t)² · t − 2 has the extremes −2 and 2 on [0, 1].
  const Polynomial one{1, 1}, t{0, 1};
  EXPECT_TRUE((one * one * t + Polynomial{-2}).is_within(2, 1));
  EXPECT_TRUE((0.5 * (one * one * t) + Polynomial{-1}).is_within(1, 1));
  EXPECT_FALSE((one * one * t + Polynomial{-2}).is_within(1.999, 1));
}

TEST(Polynomial, AgreesWithSamplesOnRandomOnes) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coefficient(-1, 1);
  for (int i = 0; i < 2000; ++i) {
    std::array<double, 9> c{};
    for (double& x : c) x = coefficient(random);
    const Polynomial polynomial{c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7], c[8]};
    const double end = 0.1 + std::abs(coefficient(random));
    double largest = 0;
    for (int k = 0; k <= 2000; ++k) {
      const double t = end * k / 2000;
      double value = 0;
      for (int n = 8; n >= 0; --n) value = value * t + c[static_cast<std::size_t>(n)];
      largest = std::max(largest, std::abs(value));
    }
    EXPECT_TRUE(polynomial.is_within(largest * (1 + 1e-4) + 1e-4, end));
    EXPECT_FALSE(polynomial.is_within(largest * (1 - 1e-9) - 1e-12, end));
  }
}

}  // namespace
}  // namespace kcs::runs
