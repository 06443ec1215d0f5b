// Sine, cosine and arc tangent against the C library's in long double, and to the bit.
#include "server/gcode/trigonometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>

namespace kcs::gcode {
namespace {

using std::numbers::pi;

constexpr double kAccuracy = 2e-16;
static_assert(std::numeric_limits<long double>::digits >= 64, "long double must be the more accurate one");

double error_of_sine_and_cosine(double angle) {
  const auto [sine, cosine] = sine_and_cosine(angle);
  const long double exact = angle;
  return static_cast<double>(std::max(std::abs(sine - std::sin(exact)), std::abs(cosine - std::cos(exact))));
}

// From 1 rad on as a share of the angle.
double error_of_arc_tangent(double y, double x) {
  const long double exact = std::atan2(static_cast<long double>(y), static_cast<long double>(x));
  return static_cast<double>(std::abs(arc_tangent(y, x) - exact) / std::max(1.0L, std::abs(exact)));
}

TEST(Trigonometry, SineAndCosineAreAccurateWithinOneTurn) {
  double largest = 0;
  for (int step = -200'000; step <= 200'000; ++step) {
    largest = std::max(largest, error_of_sine_and_cosine(2 * pi * step / 199'999));
  }
  EXPECT_LE(largest, kAccuracy);
}

TEST(Trigonometry, SineAndCosineAreAccurateOverTheWholeRange) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-20, 7);
  double largest = 0;
  for (int round = 0; round < 500'000; ++round) {
    const double magnitude = std::pow(10, exponent(random));
    largest = std::max(largest, error_of_sine_and_cosine(round % 2 == 0 ? magnitude : -magnitude));
  }
  EXPECT_LE(largest, kAccuracy);
}

TEST(Trigonometry, SineAndCosineAreAccurateAroundEveryEighthOfATurn) {
  double largest = 0;
  for (int eighths = 0; eighths < 12'000'000; eighths += eighths < 100 ? 1 : 997) {
    const double angle = eighths * (pi / 4);
    for (const double near : {angle, std::nextafter(angle, 1e8), std::nextafter(angle, -1e8), angle + 1e-9}) {
      largest = std::max(largest, error_of_sine_and_cosine(near));
    }
  }
  EXPECT_LE(largest, kAccuracy);
}

TEST(Trigonometry, SineOfASmallAngleIsAccurateToItsLastDigits) {
  double angle = 0.7;
  while (angle > 1e-300) {
    angle *= 0.83;
    const double exact = static_cast<double>(std::sin(static_cast<long double>(angle)));
    EXPECT_NEAR(sine_and_cosine(angle).sine, exact, 2.3e-16 * exact) << angle;
  }
}

TEST(Trigonometry, SineAndCosineOfDegreesAreAccurateToTheirLastDigits) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> exponent(-30, 1.6);
  std::uniform_real_distribution<double> eighth_turn(-45, 45);
  const auto error = [](double value, long double exact) {
    return static_cast<double>(std::abs((value - exact) / exact));
  };
  double largest = 0;
  for (int round = 0; round < 200'000; ++round) {
    for (const double angle : {std::pow(10, exponent(random)), eighth_turn(random)}) {
      const long double radians = angle * std::numbers::pi_v<long double> / 180;
      const auto [sine, cosine] = sine_and_cosine_of_degrees(angle);
      largest = std::max({largest, error(sine, std::sin(radians)), error(cosine, std::cos(radians))});
    }
  }
  EXPECT_LE(largest, kAccuracy);
}

TEST(Trigonometry, SineAndCosineOfDegreesAreAccurateInEveryQuarter) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> eighth_turn(-45, 45);
  for (int round = 0; round < 100'000; ++round) {
    // A multiple of 2^-30, so that whole turns can be added without rounding.
    const double angle = std::round(eighth_turn(random) * 0x1p30) / 0x1p30;
    const auto [sine, cosine] = sine_and_cosine_of_degrees(angle);
    for (const double turns : {-360.0, 0.0, 7200.0}) {
      const SineCosine second = sine_and_cosine_of_degrees(angle + 90 + turns);
      const SineCosine third = sine_and_cosine_of_degrees(angle + 180 + turns);
      const SineCosine fourth = sine_and_cosine_of_degrees(angle - 90 + turns);
      ASSERT_TRUE(second.sine == cosine && second.cosine == -sine) << angle;
      ASSERT_TRUE(third.sine == -sine && third.cosine == -cosine) << angle;
      ASSERT_TRUE(fourth.sine == -cosine && fourth.cosine == sine) << angle;
    }
  }
}

TEST(Trigonometry, SineAndCosineOfDegreesAreExactWhereTheyAreSimple) {
  const double sines[] = {0, 0.5, 1, 0.5, 0, -0.5, -1, -0.5};
  const double angles[] = {0, 30, 90, 150, 180, 210, 270, 330};
  for (int turn = -3; turn <= 3; ++turn) {
    for (std::size_t i = 0; i < std::size(angles); ++i) {
      EXPECT_EQ(sine_and_cosine_of_degrees(angles[i] + 360 * turn).sine, sines[i]) << angles[i] << " " << turn;
      EXPECT_EQ(sine_and_cosine_of_degrees(angles[i] - 90 + 360 * turn).cosine, sines[i]) << angles[i] << " " << turn;
    }
  }
  EXPECT_EQ(sine_and_cosine_of_degrees(360e12 + 90).sine, 1);
}

TEST(Trigonometry, DegreesOfPartsOfATurnAreExact) {
  EXPECT_EQ(degrees_of(pi), 180);
  EXPECT_EQ(degrees_of(-pi / 2), -90);
  EXPECT_EQ(degrees_of(pi / 4), 45);
  EXPECT_EQ(degrees_of(0), 0);
  EXPECT_EQ(degrees_of(1), 57.29577951308232);
}

TEST(Trigonometry, ArcTangentIsAccurateAllAround) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> angle(-pi, pi);
  std::uniform_real_distribution<double> exponent(-12, 14);
  double largest = 0;
  for (int round = 0; round < 500'000; ++round) {
    const double direction = angle(random);
    const double radius = std::pow(10, exponent(random));
    largest = std::max(largest, error_of_arc_tangent(radius * std::sin(direction), radius * std::cos(direction)));
  }
  EXPECT_LE(largest, kAccuracy);
}

TEST(Trigonometry, ArcTangentIsAccurateNearTheAxesAndWhereItsFormulaChanges) {
  double largest = 0;
  for (const double ratio : {1e-300, 1e-20, 1e-9, 0.25, 0.5, 0.75, 1.0}) {
    for (const double y : {ratio, std::nextafter(ratio, 2), std::nextafter(ratio, -2)}) {
      for (const double x : {1.0, -1.0}) {
        largest = std::max({largest, error_of_arc_tangent(y, x), error_of_arc_tangent(-y, x),
                            error_of_arc_tangent(x, y), error_of_arc_tangent(x, -y)});
      }
    }
  }
  EXPECT_LE(largest, kAccuracy);
}

TEST(Trigonometry, ArcTangentIsExactOnTheAxes) {
  EXPECT_EQ(arc_tangent(0, 0), 0);
  EXPECT_EQ(arc_tangent(0, 3), 0);
  EXPECT_EQ(arc_tangent(3, 0), pi / 2);
  EXPECT_EQ(arc_tangent(-3, 0), -pi / 2);
  EXPECT_EQ(arc_tangent(0, -3), pi);
  EXPECT_EQ(arc_tangent(-0.0, -3), pi);
  EXPECT_EQ(arc_tangent(3, 3), pi / 4);
}

// The sum of the bits of many results: a machine on which any of them is different does not repeat it.
TEST(Trigonometry, GivesTheSameBitsOnEveryMachine) {
  std::uint64_t sum = 0;
  const auto add = [&sum](double value) { sum = sum * 31 + std::bit_cast<std::uint64_t>(value); };
  for (int step = -50'000; step <= 50'000; ++step) {
    const auto [sine, cosine] = sine_and_cosine(step / 1024.0);
    add(sine);
    add(cosine);
    add(arc_tangent(step / 1024.0, 7 - step / 4096.0));
  }
  EXPECT_EQ(sum, 10'588'919'920'268'565'976U);
}

TEST(Trigonometry, InDegreesGivesTheSameBitsOnEveryMachine) {
  std::uint64_t sum = 0;
  const auto add = [&sum](double value) { sum = sum * 31 + std::bit_cast<std::uint64_t>(value); };
  for (int step = -50'000; step <= 50'000; ++step) {
    const auto [sine, cosine] = sine_and_cosine_of_degrees(step / 64.0);
    add(sine);
    add(cosine);
    add(degrees_of(step / 1024.0));
  }
  EXPECT_EQ(sum, 6'183'517'239'996'334'300U);
}

}  // namespace
}  // namespace kcs::gcode
