// Who a plan is made for.
#pragma once

#include "server/motion/phase.h"
#include "server/planning/corner.h"

namespace kcs::planning {

// Takes plans while they are made; what is planned is not touched again.
class PlanReceiver {
 public:
  virtual ~PlanReceiver() = default;
  virtual void take(const motion::Phase& phase) = 0;
  virtual void take(const Corner& corner) = 0;
};

}  // namespace kcs::planning
