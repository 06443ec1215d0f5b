// Exponential, logarithm and power that are the same to the last bit on every machine (why: trigonometry.h).
#pragma once

namespace kcs::gcode {

// Each is the double nearest to the true value in all but one of a billion cases, and else the one beside it; an
// exact result is always exact. Below the smallest normal double they are within one unit of the smallest of all.

// e to the power of x; infinity beyond the largest double.
double exponential(double x);

// The natural logarithm of x, > 0 and finite.
double logarithm(double x);

// base to the power of exponent, both finite; a base below zero needs a whole exponent. 1 where the exponent is 0;
// infinity beyond the largest double, and for a base of 0 with an exponent below zero.
double power(double base, double exponent);

}  // namespace kcs::gcode
