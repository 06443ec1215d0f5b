// The setpoints of a plan, batch by batch, computed as they are asked for.
#pragma once

#include <kcs/v1/planning.pb.h>

#include <cstdint>
#include <optional>

#include "server/jobs/plan_request.h"
#include "server/motion/place_sampler.h"
#include "server/motion/sampler.h"
#include "server/service/setpoint_columns.h"

namespace kcs::service {

// Holds its plan: it may be forgotten meanwhile. Its memory is that of one batch at most, whatever the plan's length.
class SetpointStream {
 public:
  // Throws planning::InvalidInput for a period, a range or a channel that cannot be served.
  SetpointStream(jobs::PlanPointer plan, const v1::StreamSetpointsRequest& request);

  // Fills `batch` with the next setpoints; false if there are none left. Giving the same batch again saves allocations.
  bool next(v1::SetpointBatch& batch);

 private:
  void add_markers(std::uint64_t size, v1::SetpointBatch& batch) const;

  jobs::PlanPointer plan_;
  double period_;  // s
  motion::Sampler sampler_;
  SetpointColumns columns_;
  std::optional<motion::PlaceSampler> places_;  // if they are wanted
  std::uint64_t next_;                          // index of the next setpoint
  std::uint64_t end_ = 0;                       // one past the last one wanted
};

}  // namespace kcs::service
