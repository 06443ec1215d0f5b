// Where a path turns sharply.
#pragma once

#include "server/planning/leg.h"

namespace kcs::planning {

// Whether a corner between two directions is sharp: it turns so much, by more than 17°, that a motion which keeps the
// tolerance may still come too little near to it, and that it takes time of its own.
bool is_sharp(const Vector& before, const Vector& after);

// Looks at legs one after the other. Legs that together are shorter than the tolerance are seen as one with the leg
// after them: a jog within the tolerance is no turn.
class SharpTurns {
 public:
  // Whether the path turns sharply where this leg begins, or what is seen as one with it.
  bool before(const Leg& leg);

 private:
  Vector direction_ = Vector::Zero();  // before
  Vector small_ = Vector::Zero();      // what the short legs since then lead to, mm
  double length_ = 0;                  // of them, mm
};

}  // namespace kcs::planning
