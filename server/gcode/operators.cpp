#include "server/gcode/operators.h"

#include <array>
#include <cmath>

#include "server/gcode/exponential.h"

namespace kcs::gcode {
namespace {

bool are_equal(double a, double b) { return std::abs(a - b) < kEqual; }

double raised(double base, double exponent, Place place) {
  if (base < 0 && exponent != std::floor(exponent)) {
    refuse(place, "a number below zero to a power that is not whole. Check the signs of both sides of **.");
  }
  if (base == 0 && exponent < 0) refuse(place, "zero to a power below zero, which is a division by zero.");
  return power(base, exponent);
}

double quotient(double left, double right, Place place) {
  if (right == 0) refuse(place, "a division by zero. Check what stands to the right of /.");
  return left / right;
}

// Never below zero, whatever the signs.
double modulus(double left, double right, Place place) {
  if (right == 0) refuse(place, "a division by zero. Check what stands to the right of MOD.");
  const double remainder = std::fmod(left, right);
  return remainder < 0 ? remainder + std::abs(right) : remainder;
}

constexpr std::array<Operator, 15> kOperators{
    {{"**", 5, raised},
     {"*", 4, [](double a, double b, Place) { return a * b; }},
     {"/", 4, quotient},
     {"MOD", 4, modulus},
     {"+", 3, [](double a, double b, Place) { return a + b; }},
     {"-", 3, [](double a, double b, Place) { return a - b; }},
     {"EQ", 2, [](double a, double b, Place) { return are_equal(a, b) ? 1.0 : 0.0; }},
     {"NE", 2, [](double a, double b, Place) { return are_equal(a, b) ? 0.0 : 1.0; }},
     {"GT", 2, [](double a, double b, Place) { return a > b ? 1.0 : 0.0; }},
     {"GE", 2, [](double a, double b, Place) { return a >= b ? 1.0 : 0.0; }},
     {"LT", 2, [](double a, double b, Place) { return a < b ? 1.0 : 0.0; }},
     {"LE", 2, [](double a, double b, Place) { return a <= b ? 1.0 : 0.0; }},
     {"AND", kLowestPrecedence, [](double a, double b, Place) { return a != 0 && b != 0 ? 1.0 : 0.0; }},
     {"OR", kLowestPrecedence, [](double a, double b, Place) { return a != 0 || b != 0 ? 1.0 : 0.0; }},
     {"XOR", kLowestPrecedence, [](double a, double b, Place) { return (a != 0) != (b != 0) ? 1.0 : 0.0; }}}};

}  // namespace

std::span<const Operator> operators() { return kOperators; }

}  // namespace kcs::gcode
