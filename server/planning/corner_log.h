// The records of a plan's corners, in order, with what was lost around them.
#pragma once

#include <optional>

#include "server/planning/plan.h"
#include "server/planning/plan_receiver.h"

namespace kcs::planning {

// A corner is passed on when the next one comes: until then more time may be lost after it.
class CornerLog {
 public:
  // Both must outlive the log. Corners are counted in `summary`.
  CornerLog(PlanReceiver& receiver, Summary& summary) : receiver_(receiver), summary_(summary) {}

  void add(const Corner& corner);
  // Time lost since the last corner, s: counts there, if there is one, or at the next one.
  void lose_after(double time);
  void lose_before(double time) { before_next_ += time; }
  // Nothing more comes.
  void finish();

 private:
  PlanReceiver& receiver_;
  Summary& summary_;
  std::optional<Corner> last_;
  double before_next_ = 0;  // s
};

}  // namespace kcs::planning
