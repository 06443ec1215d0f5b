// The setpoints of a motion while it is being planned.
#pragma once

#include <kcs/v1/planning.pb.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>

#include "server/motion/live_places.h"
#include "server/motion/live_sampler.h"
#include "server/planning/marker.h"
#include "server/planning/toolpath.h"
#include "server/service/setpoint_columns.h"

namespace kcs::service {

// Sends an answer of PlanLive. Waits while the client takes nothing; throws Cancelled if it is gone.
using SendLive = std::function<void(const v1::PlanLiveResponse&)>;

// Sends a batch when it is full, or when flush() asks for what is there. Memory: one batch.
class LiveSetpoints {
 public:
  // Throws planning::InvalidInput if `output` cannot be served.
  LiveSetpoints(const v1::LiveOutput& output, std::size_t axes, SendLive send);

  // Where the path starts, mm: before all of the following.
  void begin(const motion::Vector& start);
  // The next segment of the path that moves: before the phases that follow it.
  void add(const planning::Segment& segment);
  // The next marker: before the phase during which it is due.
  void add(const planning::MarkerAt& marker) { markers_.push_back(marker); }
  // The next phase of the motion. Throws planning::InvalidInput where the setpoints become too many.
  void add(const motion::Phase& phase);
  // Sends what is there.
  void flush();
  // The motion ends, in this state: sends the rest.
  void finish(const motion::State& end);

 private:
  void put_settled();
  void put_markers();

  SetpointColumns columns_;
  double period_;
  motion::LiveSampler sampler_;
  std::optional<motion::LivePlaces> places_;  // if they are wanted
  std::deque<planning::MarkerAt> markers_;    // that are due
  SendLive send_;
  v1::PlanLiveResponse response_;  // its batch is kept for its memory
  std::uint64_t size_ = 0;         // of the batch
};

}  // namespace kcs::service
