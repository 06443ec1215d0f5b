#include "server/planning/sharp_turns.h"

namespace kcs::planning {

bool is_sharp(const Vector& before, const Vector& after) {
  constexpr double kSharp = 0.3;  // |D|
  return (after - before).squaredNorm() >= kSharp * kSharp;
}

bool SharpTurns::before(const Leg& leg) {
  small_ += leg.length * leg.direction;
  length_ += leg.length;
  if (length_ < leg.tolerance) return false;
  const Vector direction = small_.normalized();
  const bool sharp = !direction_.isZero(0) && is_sharp(direction_, direction);
  direction_ = direction;
  small_ = Vector::Zero();
  length_ = 0;
  return sharp;
}

}  // namespace kcs::planning
