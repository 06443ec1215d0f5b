// Sine, cosine and arc tangent that are the same to the last bit on every machine.
//
// The C library's are not: it chooses between variants with and without fused multiply-add when a process starts, and
// the last bit of an arc's chords would depend on the processor. These consist of + − × ÷ and rounding, which IEEE 754
// defines to the bit, and must be compiled without contraction to fused multiply-add, as all of kcs is.
#pragma once

namespace kcs::gcode {

struct SineCosine {
  double sine;
  double cosine;
};

// The sine and the cosine of `angle`, rad, from −1e7 to 1e7. Each is within 2e-16.
SineCosine sine_and_cosine(double angle);

// Likewise for any finite angle in degrees. Exactly 0, ±1/2 and ±1 where they are that; each is within 2e-16 of its own
// value, however small.
SineCosine sine_and_cosine_of_degrees(double angle);

// The angle of the direction (x, y) to the axis of x, rad, from −π to π; 0 where both are 0, and −0 is taken for 0.
// Within 2e-16 rad, and from 1 rad on within 2e-16 of its value.
double arc_tangent(double y, double x);

// An angle in rad as degrees, rounded once.
double degrees_of(double radians);

}  // namespace kcs::gcode
