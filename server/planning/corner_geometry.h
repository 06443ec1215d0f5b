// Two legs that meet, and how far their corner may be cut.
#pragma once

#include <cmath>

#include "server/planning/leg.h"
#include "server/planning/options.h"

namespace kcs::planning {

// A curve that just touches its tolerance must not be found outside by a rounding.
inline constexpr double kToleranceMargin = 1 - 1e-7;

// Below this cosine of half the angle, from 175° on, the tool goes back on its own path.
inline constexpr double kReversal = 0.043619387365336;

// Tajima and Sencer 2016, figure 1, in vector form: nothing here is planar.
struct CornerGeometry {
  const Leg& in;
  const Leg& out;
  Vector difference = Vector::Zero();  // D = te − ts
  Vector sum = Vector::Zero();         // ts + te
  double half_sine = 0;                // sin(θ2/2) = |D|/2
  double half_cosine = 0;              // cos(θ2/2) = |ts + te|/2
  double tolerance = 0;                // the smaller of the legs', with a margin for rounding, mm
  double reach = 0;                    // how near the tool must come to the corner point, mm
  double cut = 0;                      // ε: the same with a margin for rounding; what smoothing may use
  bool straight = false;               // the direction changes by no more than rounding: nothing to smooth

  double angle() const { return 2 * std::atan2(half_sine, half_cosine); }  // θ2: 0 straight on, π reversal
};

CornerGeometry corner_geometry(const Leg& in, const Leg& out, const PlanOptions& options);

}  // namespace kcs::planning
