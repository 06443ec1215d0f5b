#include "server/gcode/functions.h"

#include <array>
#include <cmath>

#include "server/gcode/exponential.h"
#include "server/gcode/trigonometry.h"

namespace kcs::gcode {
namespace {

// The other leg of a right triangle with the hypotenuse 1.
double other_leg(double leg) { return std::sqrt((1 - leg) * (1 + leg)); }

double arc_cosine(double x, Place place) {
  if (std::abs(x) > 1) refuse(place, "the arc cosine of a number beyond 1. ACOS takes -1 to 1.");
  return degrees_of(arc_tangent(other_leg(x), x));
}

double arc_sine(double x, Place place) {
  if (std::abs(x) > 1) refuse(place, "the arc sine of a number beyond 1. ASIN takes -1 to 1.");
  return degrees_of(arc_tangent(x, other_leg(x)));
}

double tangent(double angle, Place place) {
  const auto [sine, cosine] = sine_and_cosine_of_degrees(angle);
  if (cosine == 0) refuse(place, "the tangent of a right angle, which is infinite. Check the angle: it is in degrees.");
  return sine / cosine;
}

double natural_logarithm(double x, Place place) {
  if (x <= 0) refuse(place, "the logarithm of zero or less. LN takes numbers above zero.");
  return logarithm(x);
}

double square_root(double x, Place place) {
  if (x < 0) refuse(place, "the square root of a number below zero. SQRT takes zero and above.");
  return std::sqrt(x);
}

constexpr std::array<Function, 12> kFunctions{
    {{"ABS", [](double x, Place) { return std::abs(x); }},
     {"ACOS", arc_cosine},
     {"ASIN", arc_sine},
     {"COS", [](double angle, Place) { return sine_and_cosine_of_degrees(angle).cosine; }},
     {"EXP", [](double x, Place) { return exponential(x); }},
     {"FIX", [](double x, Place) { return std::floor(x); }},
     {"FUP", [](double x, Place) { return std::ceil(x); }},
     {"LN", natural_logarithm},
     {"ROUND", [](double x, Place) { return std::round(x); }},
     {"SIN", [](double angle, Place) { return sine_and_cosine_of_degrees(angle).sine; }},
     {"SQRT", square_root},
     {"TAN", tangent}}};

}  // namespace

std::span<const Function> functions() { return kFunctions; }

}  // namespace kcs::gcode
