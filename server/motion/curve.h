// A stretch of constant-jerk motion as a curve in space.
#pragma once

#include <array>

#include "server/motion/phase.h"

namespace kcs::motion {

// A cubic by its four Bézier points. It lies in their convex hull, begins at the first and ends at the last one.
struct Curve {
  std::array<Vector, 4> points;  // mm

  // The way from one state to another that takes `time` s with constant jerk.
  static Curve between(const State& from, const State& to, double time) {
    return {{from.position, from.position + from.velocity * (time / 3), to.position - to.velocity * (time / 3),
             to.position}};
  }

  std::array<Curve, 2> halves() const {
    const auto& [a, b, c, d] = points;
    const Vector ab = (a + b) / 2, bc = (b + c) / 2, cd = (c + d) / 2;
    const Vector abc = (ab + bc) / 2, bcd = (bc + cd) / 2;
    const Vector middle = (abc + bcd) / 2;
    return {{{{a, ab, abc, middle}}, {{middle, bcd, cd, d}}}};
  }
};

}  // namespace kcs::motion
