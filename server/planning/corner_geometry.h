// Two legs that meet, and how far their corner may be cut.
#pragma once

#include "server/planning/leg.h"
#include "server/planning/options.h"

namespace kcs::planning {

// Tajima and Sencer 2016, figure 1, in vector form: nothing here is planar.
struct CornerGeometry {
  const Leg& in;
  const Leg& out;
  Vector difference = Vector::Zero();  // D = te − ts
  Vector sum = Vector::Zero();         // ts + te
  double half_sine = 0;                // sin(θ2/2) = |D|/2
  double half_cosine = 0;              // cos(θ2/2) = |ts + te|/2
  double angle = 0;                    // θ2: 0 straight on, π reversal
  double reach = 0;                    // how near the tool must come to the corner point, mm
  double cut = 0;                      // ε: the same with a margin for rounding; what smoothing may use
  bool straight = false;               // the direction changes by no more than rounding: nothing to smooth
};

CornerGeometry corner_geometry(const Leg& in, const Leg& out, const PlanOptions& options);

}  // namespace kcs::planning
