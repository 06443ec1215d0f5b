#include "server/gcode/trigonometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "server/gcode/precise.h"

namespace kcs::gcode {
namespace {

using std::numbers::pi;

constexpr double kPiRest = 1.2246467991473532e-16;
constexpr Precise kQuarterTurn{pi / 2, kPiRest / 2};
constexpr Precise kHalfTurn{pi, kPiRest};
constexpr Precise kEighthTurn{pi / 4, kPiRest / 4};
constexpr Precise kArcTangentOfHalf{4.63647609000806093515e-01, 2.26987774529616870924e-17};
constexpr Precise kRadiansPerDegree{1.7453292519943295e-02, 2.9486522708701687e-19};
constexpr Precise kDegreesPerRadian{5.7295779513082323e+01, -1.9878495670576283e-15};

// π/2 in three parts. The first two are so short that a product with a whole number below 2^24 is exact.
constexpr double kFirstPart = 0x1.921fb54p+0;
constexpr double kSecondPart = 0x0.442d184p-28;
constexpr double kThirdPart = 0x0.69898cc51701b839p-56;

// Taylor series: (sin x − x) / x³ and (cos x − 1 + x²/2) / x⁴ up to π/4, and (atan x − x) / x³ up to 1/4, by powers of
// x². What is left out is below 1e-17.
constexpr std::array kSine{-1.0 / 6,
                           1.0 / 120,
                           -1.0 / 5'040,
                           1.0 / 362'880,
                           -1.0 / 39'916'800,
                           1.0 / 6'227'020'800,
                           -1.0 / 1'307'674'368'000,
                           1.0 / 355'687'428'096'000};
constexpr std::array kCosine{1.0 / 24,
                             -1.0 / 720,
                             1.0 / 40'320,
                             -1.0 / 3'628'800,
                             1.0 / 479'001'600,
                             -1.0 / 87'178'291'200,
                             1.0 / 20'922'789'888'000};
constexpr std::array kArcTangent{-1.0 / 3, 1.0 / 5,   -1.0 / 7, 1.0 / 9,   -1.0 / 11, 1.0 / 13, -1.0 / 15,
                                 1.0 / 17, -1.0 / 19, 1.0 / 21, -1.0 / 23, 1.0 / 25,  -1.0 / 27};

template <std::size_t size>
double series(const std::array<double, size>& coefficients, double x) {
  double sum = 0;
  for (std::size_t power = size; power-- > 0;) sum = sum * x + coefficients[power];
  return sum;
}

// For −π/4 to π/4. The sum of the small terms comes first, so that rounding counts once, at the end.
double sine_of(Precise angle) {
  const double x = angle.value;
  const double square = x * x;
  return x + (x * square * series(kSine, square) + angle.rest * (1 - square / 2));
}

double cosine_of(Precise angle) {
  const double square = angle.value * angle.value;
  const double start = 1 - square / 2;
  const double rounding = (1 - start) - square / 2;
  return start + (rounding + (square * square * series(kCosine, square) - angle.rest * angle.value));
}

// Of the angle that is farther than `remainder` by `quarter_turns`.
SineCosine sine_and_cosine_of(Precise remainder, long quarter_turns) {
  const double sine = sine_of(remainder);
  const double cosine = cosine_of(remainder);
  switch (quarter_turns & 3) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

}  // namespace

SineCosine sine_and_cosine(double angle) {
  const double quarter_turns = std::round(angle / (pi / 2));
  const double coarse = angle - quarter_turns * kFirstPart;
  const double fine = coarse - quarter_turns * kSecondPart;
  const double correction = ((coarse - fine) - quarter_turns * kSecondPart) - quarter_turns * kThirdPart;
  const double value = fine + correction;
  return sine_and_cosine_of({value, (fine - value) + correction}, static_cast<long>(quarter_turns));
}

SineCosine sine_and_cosine_of_degrees(double angle) {
  // Both are exact, and so is their difference: a multiple of 90°.
  const double remainder = std::remainder(angle, 90);
  const double quarter_turns = (std::fmod(angle, 360) - remainder) / 90;
  return sine_and_cosine_of(Precise{remainder} * kRadiansPerDegree, static_cast<long>(quarter_turns));
}

double arc_tangent(double y, double x) {
  const double smaller = std::min(std::abs(x), std::abs(y));
  const double larger = std::max(std::abs(x), std::abs(y));
  if (larger == 0) return 0;

  // atan(smaller/larger) is that of 0, 1/2 or 1, whichever is near, and a remainder: atan a − atan b is
  // atan((a − b) / (1 + a b)).
  double near = 0;
  Precise angle_of_near{0, 0};
  if (smaller > 0.75 * larger) {
    near = 1;
    angle_of_near = kEighthTurn;
  } else if (smaller > 0.25 * larger) {
    near = 0.5;
    angle_of_near = kArcTangentOfHalf;
  }
  const double ratio = (smaller - near * larger) / (larger + near * smaller);
  const double square = ratio * ratio;

  // That angle is taken from the nearest axis, to one side or the other.
  const bool is_steep = std::abs(y) > std::abs(x);
  Precise axis{0, 0};
  if (is_steep) {
    axis = kQuarterTurn;
  } else if (x < 0) {
    axis = kHalfTurn;
  }
  const double side = is_steep == (x < 0) ? 1 : -1;
  const double sum = axis.value + side * angle_of_near.value;
  const double rounding = axis.value == 0 ? 0 : (axis.value - sum) + side * angle_of_near.value;
  const double small =
      rounding + axis.rest + side * (angle_of_near.rest + ratio * square * series(kArcTangent, square));
  const double magnitude = sum + (side * ratio + small);
  return y < 0 ? -magnitude : magnitude;
}

double degrees_of(double radians) { return (Precise{radians} * kDegreesPerRadian).value; }

}  // namespace kcs::gcode
