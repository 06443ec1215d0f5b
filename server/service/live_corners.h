// The corners of a motion while it is being planned.
#pragma once

#include <kcs/v1/planning.pb.h>

#include "server/planning/options.h"
#include "server/planning/plan.h"
#include "server/service/live_setpoints.h"

namespace kcs::service {

// Sends a batch when it is full, or when flush() asks for what is there.
class LiveCorners {
 public:
  // options: of the plan.
  LiveCorners(const planning::PlanOptions& options, SendLive send);

  void add(const planning::Corner& corner);
  // Sends what is there.
  void flush();

 private:
  planning::PlanOptions options_;
  SendLive send_;
  v1::PlanLiveResponse response_;
};

}  // namespace kcs::service
