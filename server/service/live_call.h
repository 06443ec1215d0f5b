// What a call of PlanLive does: path in, setpoints out.
#pragma once

#include <kcs/v1/planning.pb.h>

#include <cstdint>
#include <optional>
#include <stop_token>

#include "server/planning/live_planner.h"
#include "server/service/caps.h"
#include "server/service/incoming_path.h"
#include "server/service/live_corners.h"
#include "server/service/live_setpoints.h"

namespace kcs::service {

// Plans each message's piece of the path, and sends what is settled by it, before the next one is taken: nothing piles
// up, and a client that takes no setpoints has to wait with its path. Memory: that of the planner, of one message and
// of one batch. Both methods throw planning::InvalidInput, jobs::CapExceeded, planning::Stopped if they are asked to
// stop, and what `send` throws.
class LiveCall final : public planning::PlanReceiver {
 public:
  // Keeps a reference to `caps`. stop: how to say that the client has gone.
  LiveCall(const Caps& caps, SendLive send, std::stop_token stop = {});
  // Its parts refer to each other.
  LiveCall(const LiveCall&) = delete;
  LiveCall& operator=(const LiveCall&) = delete;

  // How many segments came with the message.
  std::uint64_t add(const v1::PlanLiveRequest& message);

  // After the last message: sends the rest, and the plan. How many segments were left to the end.
  std::uint64_t finish();

 private:
  void begin(const v1::PlanOptions& options, const v1::LiveOutput& output);
  void plan(const planning::Segment& segment);
  void flush();
  void take(const planning::Segment& segment) override;
  void take(const motion::Phase& phase) override;
  void take(const planning::Corner& corner) override;
  void take(const planning::MarkerAt& marker) override;

  const Caps& caps_;
  SendLive send_;
  std::stop_token stop_;
  std::optional<IncomingPath> incoming_;  // once the options came
  std::optional<LiveSetpoints> setpoints_;
  std::optional<LiveCorners> corners_;            // if they are wanted
  std::optional<planning::LivePlanner> planner_;  // from the first segment on
  std::uint64_t segments_ = 0;                    // that came
  std::uint64_t phases_ = 0;                      // that are settled
};

}  // namespace kcs::service
