// Who a plan is made for.
#pragma once

#include "server/motion/phase.h"
#include "server/planning/corner.h"
#include "server/planning/marker.h"
#include "server/planning/toolpath.h"

namespace kcs::planning {

// Takes plans while they are made; what is planned is not touched again.
class PlanReceiver {
 public:
  virtual ~PlanReceiver() = default;
  // The next segment that moves: before the phases that follow it.
  virtual void take(const Segment& segment) = 0;
  virtual void take(const motion::Phase& phase) = 0;
  virtual void take(const Corner& corner) = 0;
  // Before the phase during which it is due, if there is one.
  virtual void take(const MarkerAt& marker) = 0;
};

}  // namespace kcs::planning
